//! Every scheme of the catalogue: its order and form, its adjoint, parts of its steps, its saved runs, its events, its
//! tangents, and that no step allocates. `cargo test` leaves this out, since it takes a minute, and
//! `.ci/run` does not: `cargo test -p hamiltonian-core --test catalogue`.

mod adjoints;
mod allocation;
#[allow(dead_code, unused_imports)]
#[path = "../common/mod.rs"]
mod common;
mod events;
mod lanes;
mod orders;
mod runs;
mod saved;
mod steps;
mod switched;
mod tangents;
