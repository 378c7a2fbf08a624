//! Programs: instructions in loops, whose values are computed as seldom as they can be.
//!
//! Input: a model and the purposes wanted. Output: a [`Program`](program::Program), and the operations it takes.
//! Invariant: a program computes what the expressions say, and is validated before it is handed on.

mod balance;
pub mod count;
mod factor;
pub mod forces;
pub mod halves;
pub mod hoist;
pub mod interpret;
mod listing;
mod order;
pub mod pairs;
pub mod pipeline;
pub mod program;
mod request;
mod saturate;
pub mod schedule;
mod share;
mod stencil;
pub mod support;
mod validate;
