//! Runs, schemes and observers, on systems written by hand.

mod allocation;
mod between;
mod checkpoint;
mod common;
mod composition;
mod events;
mod exponential;
mod lanes;
mod observers;
mod own;
mod preserving;
#[cfg(feature = "progress")]
mod progress;
mod reach;
mod run;
mod schemes;
mod start;
mod tables;
mod tangent;
mod transformed;
mod variational;
