//! Runs, schemes and observers, on systems written by hand.

mod allocation;
mod common;
mod observers;
mod reach;
mod run;
mod start;
mod tables;
