//! Most of the generated definitions, compiled and compared with the interpreter. `cargo test` leaves this out, and
//! `.ci/run` does not: `cargo test --test generated`.

#[path = "../compiled/mod.rs"]
pub mod compiled;
#[allow(dead_code)]
mod counting;
#[path = "../compiled/more.rs"]
mod expressions;
#[allow(dead_code)]
#[path = "../../hamiltonian-symbolic/tests/common/mod.rs"]
mod symbolic;
#[allow(dead_code, unused_imports)]
#[path = "../../hamiltonian-symbolic/tests/tree/mod.rs"]
mod tree;
