//! Scalars that count, from the tests of the facade.

#[path = "../../../tests/counting/counted.rs"]
pub mod counted;
