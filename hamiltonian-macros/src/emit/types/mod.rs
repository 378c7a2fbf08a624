//! The fields and vectors of a definition.
//!
//! Input: a header, groups and parameters. Output: construction and its checks, structs of coordinates of mixed shape,
//! maps to the declared variables, serde. Invariant: nothing here reads an instruction of the program.

pub mod construct;
pub mod declared;
pub mod mixed;
pub mod reach;
pub mod record;
