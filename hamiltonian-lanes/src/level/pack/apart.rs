//! Functions of packs, one register after the other.
//!
//! Input: a function of numbers, a pack. Output: `Real::apart` of packs. Invariant: each lane has the bits of the function
//! of the whole pack, and the function is compiled for one register of a level.

use super::{Base, Nf, W};
use crate::level::pack::V;
use crate::level::register::Register;
use hamiltonian_real::OfNumbers;

/// A function of packs with one register.
pub trait OfRegisters<const N: usize>: Copy {
    /// The value.
    fn of<P: Base>(self, x: [P; N]) -> P;
}

impl Base for f64 {}
impl<R: Register> Base for V<R> {}
impl<P: Base> Base for Nf<P> {}
impl<P: Base, const K: usize> Base for W<P, K> {
    /// The calls stand in a function of their own: a loop that interprets code has many places that call it.
    #[inline(always)]
    fn by_registers<F: OfRegisters<N>, const N: usize>(f: F, x: [Self; N]) -> Self {
        P::out_of_line(
            #[inline(always)]
            || {
                let mut values = [P::default(); K];
                for (k, value) in values.iter_mut().enumerate() {
                    let mut of_register = [P::default(); N];
                    for (to, x) in of_register.iter_mut().zip(&x) {
                        *to = x.0[k];
                    }
                    *value = P::by_registers(f, of_register);
                }
                W(values)
            },
        )
    }
}

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

/// The same without fused products.
#[derive(Clone, Copy)]
pub(super) struct Unfused<F>(pub(super) F);

impl<F: OfNumbers<N>, const N: usize> OfRegisters<N> for Unfused<F> {
    #[inline(always)]
    fn of<P: Base>(self, x: [P; N]) -> P {
        let mut unfused = [Nf(P::default()); N];
        for (to, x) in unfused.iter_mut().zip(&x) {
            *to = Nf(*x);
        }
        P::out_of_line(
            #[inline(always)]
            || self.0.of(unfused).0,
        )
    }
}
