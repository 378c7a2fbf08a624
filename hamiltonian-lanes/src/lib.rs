//! The scalars of `hamiltonian`: what schemes and emitted programs compute with.
//!
//! Input: numbers of the caller. Output: [`Real`], the arithmetic everything is generic over, for
//! `f64`, `f32`, [`Dual`] numbers (exact derivatives, nested for higher orders) and
//! [`DoubleDouble`] (about 106 bits). Invariant: a scalar is a value of fixed size without heap
//! memory, and every operation is total: NaN and infinities, never a panic.
//!
//! ```
//! use hamiltonian_lanes::{DoubleDouble, Dual, Real};
//!
//! fn energy<T: Real>(q: T, p: T) -> T {
//!     p * p / T::constant(2.0, 0.0) - q.cos()
//! }
//!
//! assert_eq!(energy(0.0, 2.0), 1.0);
//! // ∂H/∂p at (q, p) = (0, 2)
//! assert_eq!(energy(Dual::fixed(0.0), Dual::variable(2.0)).eps, 2.0);
//! // The same in 32 digits.
//! assert_eq!(energy(DoubleDouble::from(0.0), DoubleDouble::from(2.0)).to_f64(), 1.0);
//! ```
#![cfg_attr(not(feature = "std"), no_std)]
#![deny(unsafe_code)]

mod real;

mod elementary;
mod float;
mod word;

mod double_double;
mod dual;

#[allow(unsafe_code)]
mod level;
mod pack;

mod lift;

pub use double_double::{DoubleDouble, ParseDoubleDoubleError};
pub use dual::Dual;
pub use level::{Cpu, Kernel, Level, dispatch, dispatch_at_most};
pub use pack::{Nf, Pack, W};
pub use real::{Lift, Mask, Real};
