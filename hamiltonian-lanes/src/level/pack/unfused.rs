//! Any pack without fusing.
//!
//! Input: a pack. Output: [`Nf`]. Invariant: every lane has the bits of `f64`, on every level: a
//! product and a sum are rounded apart, in formulas and inside elementary functions.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::apart::OfRegisters;
use super::{Base, assigning};
use hamiltonian_real::parts::elementary;
use hamiltonian_real::parts::{Rare, Word};
use hamiltonian_real::{OfNumbers, Pack, Real, itself_in_lanes};

/// A pack whose [`fma`](Real::fma) rounds twice, as that of `f64` does: the bits of single runs on
/// every CPU, for 20 to 50 % more time on levels that fuse.
///
/// ```
/// use hamiltonian::lanes::{Kernel, Level, Nf, dispatch};
/// use hamiltonian::prelude::*;
///
/// struct Product;
/// impl Kernel for Product {
///     type Output = f64;
///     fn run<L: Level>(self) -> f64 {
///         let x = Nf(L::Pack::constant(0.1, 0.0));
///         x.fma(x, -x * x).lane(0)
///     }
/// }
/// // A fused product would leave the rounding error of 0.1².
/// assert_eq!(dispatch(Product), 0.0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(transparent)]
pub struct Nf<P>(pub P);

macro_rules! operators {
    ($($Trait:ident $method:ident;)*) => {
        $(
            impl<P: Base> $Trait for Nf<P> {
                type Output = Self;
                #[inline(always)]
                fn $method(self, other: Self) -> Self {
                    Self(self.0.$method(other.0))
                }
            }
        )*
    };
}

operators! {
    Add add;
    Sub sub;
    Mul mul;
    Div div;
}
assigning! { [P: Base] Nf<P> }

impl<P: Base> Neg for Nf<P> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<P: Base> Base for Nf<P> {}

/// A function of numbers in a function of its own, without fused products.
#[derive(Clone, Copy)]
struct Unfused<F>(F);

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

impl<P: Base> Real for Nf<P> {
    type Mask = P::Mask;
    type Size = Self;
    const LANES: u32 = P::LANES;
    itself_in_lanes! {}

    #[inline(always)]
    fn constant(hi: f64, lo: f64) -> Self {
        Self(P::constant(hi, lo))
    }
    #[inline(always)]
    fn fma(self, b: Self, c: Self) -> Self {
        self * b + c
    }
    #[inline(always)]
    fn select(mask: P::Mask, yes: Self, no: Self) -> Self {
        Self(P::select(mask, yes.0, no.0))
    }
    #[inline(always)]
    fn replaced(mask: P::Mask, new: Self, old: Self) -> Self {
        Self(P::replaced(mask, new.0, old.0))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> P::Mask {
        self.0.lt(other.0)
    }
    #[inline(always)]
    fn le(self, other: Self) -> P::Mask {
        self.0.le(other.0)
    }
    #[inline(always)]
    fn equals(self, other: Self) -> P::Mask {
        self.0.equals(other.0)
    }
    #[inline(always)]
    fn magnitude(self) -> f64 {
        self.0.magnitude()
    }
    #[inline(always)]
    fn size(self) -> Self {
        Self(self.0.size())
    }
    #[inline(always)]
    fn finite(self) -> P::Mask {
        self.0.finite()
    }
    #[inline(always)]
    fn lane(self, k: u32) -> f64 {
        self.0.lane(k)
    }
    #[inline(always)]
    fn look_up<const M: usize, const N: usize>(
        at: [Self; M],
        table: impl Fn([f64; M]) -> [f64; N],
    ) -> [Self; N] {
        let mut inner = [P::default(); M];
        for (to, x) in inner.iter_mut().zip(&at) {
            *to = x.0;
        }
        let numbers = P::look_up(inner, table);
        let mut found = [Self::default(); N];
        for (to, number) in found.iter_mut().zip(numbers) {
            *to = Self(number);
        }
        found
    }
    #[inline(always)]
    fn out_of_line<A>(f: impl FnOnce() -> A) -> A {
        P::out_of_line(f)
    }
    #[inline(always)]
    fn apart<F: OfNumbers<N>, const N: usize>(f: F, x: [Self; N]) -> Self {
        let mut fused = [P::default(); N];
        for (to, x) in fused.iter_mut().zip(&x) {
            *to = x.0;
        }
        Self(P::by_registers(Unfused(f), fused))
    }
    fn read_words(next: &mut dyn FnMut() -> f64) -> Self {
        Self(P::read_words(next))
    }
    #[inline(always)]
    fn epsilon() -> f64 {
        f64::EPSILON
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    #[inline(always)]
    fn sign(self) -> Self {
        Self(self.0.sign())
    }
    elementary! { #[inline(always)] }
}

impl<P: Base> Word for Nf<P> {
    type Bits = P::Bits;
    const FUSED: bool = false;

    #[inline(always)]
    fn bits(self) -> P::Bits {
        self.0.bits()
    }
    #[inline(always)]
    fn from_bits(bits: P::Bits) -> Self {
        Self(P::from_bits(bits))
    }
    #[inline(always)]
    fn odd(bits: P::Bits) -> P::Mask {
        P::odd(bits)
    }
    #[inline(always)]
    fn scaled(self, k: Self) -> Option<Self> {
        Some(Self(self.0.scaled(k.0)?))
    }
    #[inline(always)]
    fn rare_of_each<F: Rare<N, M>, const N: usize, const M: usize, const K: usize>(
        x: [[Self; N]; K],
        _fusing: bool,
    ) -> [[Self; M]; K] {
        let mut inner = [[P::default(); N]; K];
        for (inner, x) in inner.iter_mut().zip(&x) {
            for (to, x) in inner.iter_mut().zip(x) {
                *to = x.0;
            }
        }
        let inner = P::rare_of_each::<F, N, M, K>(inner, false);
        let mut values = [[Self::default(); M]; K];
        for (values, inner) in values.iter_mut().zip(&inner) {
            for (value, y) in values.iter_mut().zip(inner) {
                *value = Self(*y);
            }
        }
        values
    }
    #[inline(always)]
    fn two_over_pi(bits: P::Bits) -> [Self; 4] {
        let [a, b, c, d] = P::two_over_pi(bits);
        [Self(a), Self(b), Self(c), Self(d)]
    }
    #[inline(always)]
    fn replace(self, mask: P::Mask, x: Self, f: fn(f64) -> f64) -> Self {
        Self(self.0.replace(mask, x.0, f))
    }
    #[inline(always)]
    fn replace2(self, mask: P::Mask, x: Self, y: Self, f: fn(f64, f64) -> f64) -> Self {
        Self(self.0.replace2(mask, x.0, y.0, f))
    }
}

impl<P: Base> Pack for Nf<P> {
    #[inline(always)]
    fn load(from: &[f64], missing: f64) -> Self {
        Self(P::load(from, missing))
    }
    #[inline(always)]
    fn store(self, into: &mut [f64]) {
        self.0.store(into);
    }
    #[inline(always)]
    fn below(n: u32) -> P::Mask {
        P::below(n)
    }
}
