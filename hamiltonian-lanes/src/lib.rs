//! The wide scalars of `hamiltonian`: packs of lanes, the levels of CPUs, double-doubles.
//!
//! Input: the scalars of `hamiltonian-real`, which are re-exported here. Output: [`Real`] for
//! [`DoubleDouble`] (about 106 bits) and for packs of lanes, and the levels of CPUs that packs belong
//! to. Invariant: a scalar is a value of fixed size without heap memory, and every operation is
//! total: NaN and infinities, never a panic.
//!
//! # Scalars and levels
//! | scalar | lanes | `fma` | where it comes from |
//! |---|---|---|---|
//! | `f64` | 1 | two roundings | everywhere; the bits of single runs |
//! | [`Level::Scalar`] | 1 | as the level's packs | a [`Kernel`]'s level |
//! | [`Level::Pack`] | 2, 4 or 8 | one rounding on Neon, Avx2, Avx512 | the same: one register |
//! | [`Level::Wide`] | 8, 16, 24 or 64 | the same | the same: registers in lock-step |
//! | [`Level::Several`] | 8, 16, 24 or 32 | the same | the same, for more numbers |
//! | [`Level::Eight`] | 8 | the same | the same: as many registers as it takes |
//! | [`W<P, K>`](W) | `K` × those of `P` | as `P` | any pack, `f64` too |
//! | [`Nf<P>`](Nf) | those of `P` | two roundings: the bits of `f64` | any pack |
//!
//! [`dispatch`] detects the features of the CPU once and runs a kernel on the best level, without build flags;
//! [`dispatch_at_most`] hides features. [`Cpu`] lists the levels. Without the feature `std`, features are not
//! detected: the best level is that of the compilation target.
//!
//! By this crate alone, a sine over a pack, on the best level this CPU has:
//! ```
//! use hamiltonian_lanes::{Kernel, Level, Pack, Real, dispatch};
//!
//! struct Sines<'a>(&'a mut [f64]);
//!
//! impl Kernel for Sines<'_> {
//!     type Output = ();
//!     #[inline(always)]
//!     fn run<L: Level>(self) {
//!         for part in self.0.chunks_mut(L::Pack::LANES as usize) {
//!             L::Pack::load(part, 0.0).sin().store(part);
//!         }
//!     }
//! }
//!
//! let mut angles = [0.0, 0.5, 1.0, 1.5, 2.0];
//! dispatch(Sines(&mut angles));
//! assert!((angles[4] - 0.9092974268256817).abs() < 1e-15);
//! ```
//!
//! About 32 digits from a double-double, by the same generic code as `f64`:
//! ```
//! use hamiltonian_lanes::{DoubleDouble, Real};
//!
//! let root = DoubleDouble::from(2.0).sqrt();
//! assert_eq!(root.to_string(), "1.4142135623730950488016887242097");
//! ```
#![cfg_attr(not(feature = "std"), no_std)]
#![deny(unsafe_code)]
// A public signature must not give away a level that not every CPU has.
#![deny(private_bounds, private_interfaces)]

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}

mod double_double;

#[allow(unsafe_code)]
mod level;

pub use double_double::{DoubleDouble, ParseDoubleDoubleError};
pub use hamiltonian_real::{
    Dual, Mask, OfNumbers, Pack, Parameter, Real, computed_together, itself_in_lanes,
};
pub use level::{AtHand, Base, Called, Cpu, Kernel, Level, Nf, W, dispatch, dispatch_at_most};
