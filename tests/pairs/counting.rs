//! Scalars that count.

#[path = "../counting/counted.rs"]
pub mod counted;
