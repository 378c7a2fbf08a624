//! What rustc and cargo make of definitions: messages, lints, crates under other names, limits, and the instructions that
//! the macro takes. Each test calls them for many programs, so `cargo test` leaves this out, and `.ci/run` does not:
//! `cargo test --test toolchain`.

// As `profiles` names it.
extern crate hamiltonian as mechanics;

mod budgets;
mod cargo;
mod crates;
mod limits;
mod profiles;
mod sizes;
mod ui;
#[path = "../../benches/support/valgrind.rs"]
mod valgrind;

/// Returns true if the long versions of the tests were asked for.
fn is_heavy() -> bool {
    std::env::var_os("HAMILTONIAN_HEAVY").is_some_and(|value| value == "1")
}
