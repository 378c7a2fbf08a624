//! Bits: those of runs are recorded, those of members and of lanes are those of lone runs, on every CPU. `.ci/run` has
//! these tests for aarch64 as well.

#[allow(dead_code, unused_imports)]
mod common;
mod lanes;
mod members;
#[path = "../common/recorded.rs"]
mod recorded;
mod schemes;
