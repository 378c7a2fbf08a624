//! Bodies of functions.
//!
//! Input: functions of a program: steps with inputs and results. Output: text of their bodies, of the functions that long
//! bodies call, of the wrappers of Rust functions, and of the holders that carry prepared values. Invariant: a body binds
//! everything that it reads before its first step.

pub mod derived;
pub mod externals;
pub mod function;
pub mod holder;
pub mod parts;
