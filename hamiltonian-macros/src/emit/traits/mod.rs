//! Implementations of the traits of core.
//!
//! Input: the functions of a program and the proven structure. Output: text of `System`, `Dynamics`, `VectorField`, `Split`,
//! the markers and the description. Invariant: every method that a trait requires is there.

pub mod description;
pub mod dynamics;
pub mod kicks;
pub mod markers;
pub mod observables;
pub mod pieces;
