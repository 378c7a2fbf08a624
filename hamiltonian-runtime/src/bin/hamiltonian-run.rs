//! `hamiltonian-run FILE`: a definition with its run in one text file, to tables.
//!
//! Input: arguments. Output: what [`command`](hamiltonian_runtime::command) writes. Invariant: an error ends the program with
//! a failure.
#![forbid(unsafe_code)]

use std::process::ExitCode;

fn main() -> ExitCode {
    match hamiltonian_runtime::command(std::env::args().skip(1)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}
