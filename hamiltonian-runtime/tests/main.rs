//! Definitions at run time: the errors of the macro, the bits of the interpreter and of compiled runs.

#[path = "../../hamiltonian-core/tests/common/allocator.rs"]
mod allocator;
mod command;
mod common;
mod corpus;
mod diagnostics;
mod named;
mod refusals;
mod runs;
mod tolerance;
mod variables;
