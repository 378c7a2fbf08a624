//! Programs: instructions in loops, whose values are computed as seldom as they can be.
//!
//! Input: a model and what is asked of it. Output: a [`Program`](program::Program), and what it costs.
//! Invariant: a program computes what the expressions say, and is validated before it is handed on.

mod balance;
pub mod count;
mod factor;
pub mod forces;
pub mod hoist;
pub mod interpret;
mod listing;
mod order;
pub mod pairs;
pub mod pipeline;
pub mod program;
pub mod schedule;
mod share;
mod stencil;
mod validate;
