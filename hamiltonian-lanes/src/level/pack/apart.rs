//! Functions of packs, one register after the other.
//!
//! Input: a function of numbers, a pack. Output: `Real::apart` of packs. Invariant: each lane has the bits of the function
//! of the whole pack, and the function is compiled for one register of a level.

use super::Base;
use hamiltonian_real::OfNumbers;

/// A function of packs with one register.
pub trait OfRegisters<const N: usize>: Copy {
    /// The value.
    fn of<P: Base>(self, x: [P; N]) -> P;
}

impl Base for f64 {}

/// A function of numbers in a function of its own.
#[derive(Clone, Copy)]
pub(super) struct Apart<F>(pub(super) F);

impl<F: OfNumbers<N>, const N: usize> OfRegisters<N> for Apart<F> {
    #[inline(always)]
    fn of<P: Base>(self, x: [P; N]) -> P {
        P::out_of_line(
            #[inline(always)]
            || self.0.of(x),
        )
    }
}
