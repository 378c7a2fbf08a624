//! Steps in charts, of stages in lanes, of processed schemes and of planets. `cargo test` leaves this out, since it is a
//! quarter of what rustc compiles for the tests of the facade, and `.ci/run` does not: `cargo test --test steps`.

#[path = "../../hamiltonian-core/tests/common/allocator.rs"]
mod allocator;
mod canonical;
#[allow(dead_code, unused_imports, unused_macros)]
#[path = "../common/mod.rs"]
mod common;
pub mod coordinates;
#[allow(dead_code)]
#[path = "../generated/counting.rs"]
mod counting;
pub mod planets;
mod processed;
mod stages;
#[allow(dead_code)]
#[path = "../../hamiltonian-symbolic/tests/common/mod.rs"]
mod symbolic;
