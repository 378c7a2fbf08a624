//! Loops taken apart: a walk over an expression with its loops run at given sizes, numbers at
//! sample points, and the same system unrolled.
//!
//! Input: a model and sizes. Output: values or another model. Invariant: values at sizes
//! chosen here may refute a statement about all sizes, never prove one.

pub mod field;
mod guard;
pub mod numeric;
pub mod unroll;
mod walk;

pub use guard::guarded;
pub use numeric::{Sample, SamplePoint, Signs, sample};
pub(crate) use numeric::{Values, next_random};
pub use unroll::{unroll, unroll_nodes, unrolled};
