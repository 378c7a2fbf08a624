//! The scalar whose functions are calls.

#[path = "../counting/counted.rs"]
pub mod counted;
