//! The symbolic engine of `hamiltonian`: expressions as mathematics, from H to a scheduled program.
#![forbid(unsafe_code)]

pub mod dag;
pub mod diff;
pub mod index;
pub mod model;
pub mod op;
pub mod program;
pub mod rational;
pub mod simplify;
