//! Vector fields, exact flows and one-step maps.
//!
//! Input: the bodies that the macro emits, a prepared system, a coefficient. Output: fields and exact flows
//! with that coefficient folded in, and the contract of a [`Map`](map::Map), one step of a scheme.

pub(crate) mod emitted;
pub(crate) mod exponential;
pub(crate) mod held;
pub(crate) mod iterate;
pub(crate) mod map;
pub(crate) mod narrow;
pub(crate) mod push;
