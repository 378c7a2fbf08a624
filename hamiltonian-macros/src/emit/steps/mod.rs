//! Questions about the steps of a program.
//!
//! Input: steps. Output: the values and slices that they read and write, elements that a loop reaches with its variable,
//! values that are written where they are used, and an order in which calls of one function are neighbours. Invariant: no
//! statement is written here.

pub mod accesses;
pub mod inline;
pub mod scan;
pub mod together;
