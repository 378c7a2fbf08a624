//! Loops over pairs and loops on threads, of systems that the macro makes: what takes many steps. `cargo test` leaves this
//! out, and `.ci/run` does not: `cargo test --release --test pairs`. `tests/loops.rs` has the shapes of loops.

#[path = "../../hamiltonian-core/tests/common/allocator.rs"]
mod allocator;
mod calls;
#[allow(dead_code)]
mod common;
#[allow(dead_code)]
mod counting;
mod pairs;
#[allow(dead_code)]
#[path = "../../hamiltonian-symbolic/tests/common/mod.rs"]
mod symbolic;
mod threads;
#[allow(dead_code, unused_imports)]
#[path = "../../hamiltonian-symbolic/tests/tree/mod.rs"]
mod tree;
