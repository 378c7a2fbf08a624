//! Results of runs: tables, saved runs, and Zarr stores of sweeps, written chunk by chunk.
//!
//! Input: rows of numbers, the words of a run. Output: files, and the same rows and words read from them.
//! [`Table`](crate::Table), [`Checkpoint`](crate::Checkpoint) and [`Shard`](crate::Shard) are at the root of the crate.

pub(crate) mod checkpoint;
pub(crate) mod shard;
#[cfg(feature = "std")]
pub(crate) mod store;
pub(crate) mod table;

#[cfg(feature = "std")]
pub use store::{Attribute, ChunkData, Completeness, Layout, Rows, Store};
