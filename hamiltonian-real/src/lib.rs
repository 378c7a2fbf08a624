//! The scalars of `hamiltonian`, with which schemes and emitted programs compute.
//!
//! Input: numbers of the caller. Output: [`Real`], the arithmetic of all generic code, for `f64`,
//! `f32` and [`Dual`] numbers (exact derivatives, nested for higher orders), and the elementary
//! functions, written once for numbers and for lanes. Invariant: a scalar is a value of fixed size
//! without heap memory, and every operation is total: NaN and infinities, never a panic.
//!
//! Packs of lanes, the levels of CPUs and double-doubles are in `hamiltonian-lanes`, which uses the
//! [`parts`] of this crate and re-exports its scalars.
//!
//! Derivatives of a generic function, by this crate alone:
//! ```
//! use hamiltonian_real::{Dual, Real};
//!
//! fn energy<T: Real>(q: T, p: T) -> T {
//!     p * p / T::constant(2.0, 0.0) - q.cos()
//! }
//!
//! assert_eq!(energy(0.0, 2.0), 1.0);
//! // ∂H/∂p at (q, p) = (0, 2)
//! assert_eq!(energy(Dual::fixed(0.0), Dual::variable(2.0)).eps, 2.0);
//! // ∂²H/∂q² there: a dual of duals.
//! let q = Dual::new(Dual::variable(0.0), Dual::fixed(1.0));
//! let p = Dual::fixed(Dual::fixed(2.0));
//! assert_eq!(energy(q, p).eps.eps, 1.0);
//! ```
#![cfg_attr(not(feature = "std"), no_std)]
#![forbid(unsafe_code)]

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}

mod real;

mod two_over_pi;
mod word;

#[doc(hidden)]
pub mod elementary;
mod float;

mod dual;

pub use dual::Dual;
pub use real::{Mask, OfNumbers, Pack, Parameter, Real};

/// The parts for crates that define further scalars.
///
/// A type that implements [`Word`](parts::Word) gets the elementary functions of `f64`, with the same
/// bits where it does not fuse, from the macro `elementary!` inside its implementation of [`Real`].
pub mod parts {
    #[doc(hidden)]
    pub use crate::elementary;
    pub use crate::elementary::exact;
    pub use crate::elementary::reduction::reduce;
    pub use crate::real::series;
    pub use crate::real::words;
    #[doc(hidden)]
    pub use crate::two_over_pi::TWO_OVER_PI_MODULO_4;
    pub use crate::word::{Bits, Rare, Word};
}
