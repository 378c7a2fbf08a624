//! Runs, schemes and observers, on systems written by hand. What every scheme of the catalogue is held to is in
//! `catalogue`.

mod between;
mod blame;
mod changes;
mod checkpoint;
#[allow(dead_code)]
mod common;
mod composition;
mod described;
mod domain;
mod errors;
mod estimate;
mod events;
mod exponential;
mod function;
mod observers;
mod own;
mod preserving;
mod processed;
#[cfg(feature = "progress")]
mod progress;
mod reach;
mod roots;
mod run;
mod schemes;
mod shard;
mod start;
mod store;
mod table;
mod tables;
mod tangent;
mod transformed;
mod variational;
