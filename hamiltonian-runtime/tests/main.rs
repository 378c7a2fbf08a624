//! Definitions at run time: the errors of the macro, the bits of the interpreter and of compiled runs.

mod command;
mod common;
mod corpus;
mod diagnostics;
mod named;
mod refusals;
mod runs;
