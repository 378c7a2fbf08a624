//! The scalars of `hamiltonian`, with which schemes and emitted programs compute.
//!
//! Input: numbers of the caller. Output: [`Real`], the arithmetic everything is generic over, for
//! `f64`, `f32`, [`Dual`] numbers (exact derivatives, nested for higher orders), [`DoubleDouble`]
//! (about 106 bits) and packs of lanes; the levels of CPUs that packs belong to. Invariant: a scalar
//! is a value of fixed size without heap memory, and every operation is total: NaN and infinities,
//! never a panic.
//!
//! # Scalars and levels
//! | scalar | lanes | `fma` | where it comes from |
//! |---|---|---|---|
//! | `f64` | 1 | two roundings | everywhere; the bits of single runs |
//! | [`Level::Scalar`] | 1 | as the level's packs | a [`Kernel`]'s level |
//! | [`Level::Pack`] | 2, 4 or 8 | one rounding on Neon, Avx2, Avx512 | the same: one register |
//! | [`Level::Wide`] | 8, 16, 24 or 80 | the same | the same: registers in lock-step |
//! | [`W<P, K>`](W) | `K` × those of `P` | as `P` | any pack, `f64` too |
//! | [`Nf<P>`](Nf) | those of `P` | two roundings: the bits of `f64` | any pack |
//!
//! [`dispatch`] asks the CPU once and runs a kernel on its best level, with a plain `cargo build`;
//! [`dispatch_at_most`] hides features. [`Cpu`] lists the levels. Without the feature `std` nobody
//! asks the CPU: the best level is that of the target the crate is compiled for.
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

mod kepler;

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
