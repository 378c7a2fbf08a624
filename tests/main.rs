//! The library as its users see it: definitions through the macro, and runs. What rustc and cargo make of definitions is
//! in `toolchain`, most of the generated definitions are in `generated`.

// Under another name, as `hygiene` names it.
extern crate hamiltonian as mechanics;

#[path = "../hamiltonian-core/tests/common/allocator.rs"]
mod allocator;
pub mod arrays;
pub mod brackets;
mod circles;
mod common;
pub mod compiled;
mod compositions;
mod corpus;
mod counting;
pub mod dynamics;
mod examples;
#[path = "compiled/expressions.rs"]
mod expressions;
pub mod flows;
mod forces;
pub mod geometry;
mod given;
mod halves;
pub mod hygiene;
pub mod invariants;
pub mod lagrangian;
pub mod language;
mod lattices;
mod layout;
pub mod long;
mod loops;
mod matrices;
mod names;
pub mod numbers;
mod nystrom;
pub mod order;
mod pages;
pub mod paper;
mod periodic;
mod plot;
mod potentials;
mod products;
#[path = "../hamiltonian-core/tests/common/python.rs"]
mod python;
pub mod readme;
mod reindexed;
pub mod sizes;
mod source;
pub mod splits;
mod stack;
mod switched;
#[allow(dead_code)]
#[path = "../hamiltonian-symbolic/tests/common/mod.rs"]
mod symbolic;
pub mod systems;
mod tolerance;
#[allow(dead_code, unused_imports)]
#[path = "../hamiltonian-symbolic/tests/tree/mod.rs"]
mod tree;
pub mod variables;
