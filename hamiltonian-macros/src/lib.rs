//! wip
#![allow(dead_code)]
mod ast;
mod checked;
mod names;
mod report;
