//! Exact flows: H as a sum of pieces whose flows are known in closed form.
//!
//! Input: a model. Output: pieces with their flows ([`split`]). Invariant: every flow is an instance of a form,
//! or made of such by theorems whose conditions are proven.

mod limits;
mod solve;
mod space;
pub mod split;
