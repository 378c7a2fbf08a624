//! Proofs: what holds of a model, of another form of it, and of its invariants.
//!
//! Input: a model. Output: its structure, H of an L, another model, verdicts. Invariant: what is said to hold
//! is proven; what is refuted has a point that refutes it.

pub mod bracket;
pub mod facts;
pub mod jumps;
pub mod legendre;
pub mod structure;
pub mod transform;
