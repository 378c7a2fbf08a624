//! The symbolic engine of `hamiltonian`: expressions as mathematics, from H to a scheduled program.
#![forbid(unsafe_code)]

pub mod balance;
pub mod bracket;
mod closed;
pub mod count;
pub mod dag;
pub mod diff;
pub mod factor;
pub mod facts;
pub mod flow;
pub mod forces;
mod formula;
pub mod hold;
pub mod index;
pub mod legendre;
mod listing;
pub mod loops;
pub mod model;
pub mod normal_form;
mod order;
pub mod pipeline;
pub mod print;
pub mod program;
pub mod rational;
mod reindex;
pub mod rewrite;
pub mod schedule;
pub mod share;
pub mod simplify;
pub mod split;
mod stencil;
pub mod structure;
pub mod transform;
mod validate;

pub use dag::op;

/// The second word of π: `π = f64::consts::PI + PI_LOW` to 106 bits.
pub const PI_LOW: f64 = 1.224_646_799_147_353_2e-16;
