//! Algebra: expressions, models of them, derivatives, the normal form, and printing.
//!
//! Input: expressions by constructors. Output: expressions, numbers and text. Invariant: numbers are exact
//! rationals, and expressions are built by the constructors of [`simplify`]. Passes of `programs`, and [`rewrite`],
//! also intern nodes that these constructors would change.

pub(crate) mod ball;
mod closed;
pub mod dag;
pub mod diff;
pub(crate) mod formula;
pub mod index;
pub mod list;
pub mod loops;
pub mod model;
pub mod normal_form;
pub mod overflow;
mod present;
pub mod print;
pub mod product;
pub mod ranges;
pub mod rational;
mod reindex;
mod rewrite;
pub mod set;
pub(crate) mod simplify;
pub mod sort;
