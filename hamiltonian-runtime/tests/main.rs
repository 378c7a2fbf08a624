//! Definitions at run time: the errors of the macro, the bits of the interpreter and of compiled runs.

extern crate proc_macro;

#[path = "../../hamiltonian-core/tests/common/allocator.rs"]
mod allocator;
// The stages of the macro, which cannot be called from outside of rustc.
#[allow(dead_code)] // Its own analysis.
#[path = "../../hamiltonian-macros/src/backend.rs"]
mod backend;
mod command;
mod common;
mod corpus;
mod diagnostics;
#[allow(unexpected_cfgs)] // A feature of the macro.
#[path = "../../hamiltonian-macros/src/emit/mod.rs"]
mod emit;
mod emitted;
mod lanes;
mod named;
mod refusals;
mod runs;
mod tolerance;
mod variables;
