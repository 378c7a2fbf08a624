//! Any pack by calls.
//!
//! Input: a pack. Output: [`Called`]. Invariant: every lane has the bits of the pack.

use core::ops::{Add, Div, Mul, Neg, Sub};

use super::assigning;
use hamiltonian_real::{Pack, Real, itself_in_lanes};

/// A pack whose operations are functions of their own, for code that is compiled without optimisation.
///
/// rustc copies the operations of a pack to each place of use, also where it does not optimise. The way of a loop into a
/// level is then 71 kB of machine code, the mean of the loops in this library's tests. With calls it is 24 kB. In optimised
/// code a call in a lane loop costs a factor of fifty.
///
/// ```
/// use hamiltonian::lanes::{Called, W};
/// use hamiltonian::prelude::*;
///
/// let x = W([0.5, 1.0]);
/// let sines = Called(x).sin();
/// assert_eq!(sines, Called(x.sin()));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(transparent)]
pub struct Called<P>(pub P);

macro_rules! operators {
    ($($Trait:ident $method:ident;)*) => {
        $(
            impl<P: Pack> $Trait for Called<P> {
                type Output = Self;
                #[inline]
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
assigning! { [P: Pack] Called<P> }

impl<P: Pack> Neg for Called<P> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

/// Functions of packs, by those of the pack.
macro_rules! functions {
    ($($name:ident($($other:ident),*);)*) => {
        $(
            #[inline]
            fn $name(self $(, $other: Self)*) -> Self {
                Self(self.0.$name($($other.0),*))
            }
        )*
    };
}

/// Comparisons.
macro_rules! comparisons {
    ($($name:ident)*) => {
        $(
            #[inline]
            fn $name(self, other: Self) -> P::Mask {
                self.0.$name(other.0)
            }
        )*
    };
}

impl<P: Pack> Real for Called<P> {
    type Mask = P::Mask;
    type Size = Self;
    const LANES: u32 = P::LANES;
    itself_in_lanes! {}

    functions! {
        fma(b, c);
        mul_absorbing(factor);
        recip();
        sqrt();
        cbrt();
        abs();
        sign();
        floor();
        round();
        modulo(other);
        remainder(other);
        sin();
        cos();
        tan();
        asin();
        acos();
        atan();
        sinh();
        cosh();
        tanh();
        asinh();
        acosh();
        atanh();
        exp();
        exp_m1();
        ln();
        ln_1p();
        erf();
        erfc();
        atan2(other);
        hypot(other);
        pow(exponent);
        min(other);
        max(other);
        universal_anomaly(b, c);
        orbit_remainder(c);
        stumpff_2();
        stumpff_3();
    }
    comparisons! { lt le equals }

    #[inline]
    fn constant(hi: f64, lo: f64) -> Self {
        Self(P::constant(hi, lo))
    }
    #[inline]
    fn select(mask: P::Mask, yes: Self, no: Self) -> Self {
        Self(P::select(mask, yes.0, no.0))
    }
    #[inline]
    fn magnitude(self) -> f64 {
        self.0.magnitude()
    }
    #[inline]
    fn size(self) -> Self {
        Self(self.0.size())
    }
    #[inline]
    fn finite(self) -> P::Mask {
        self.0.finite()
    }
    #[inline]
    fn is_finite(self) -> bool {
        self.0.is_finite()
    }
    #[inline]
    fn lane(self, k: u32) -> f64 {
        self.0.lane(k)
    }
    #[inline]
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
    #[inline]
    fn out_of_line<A>(f: impl FnOnce() -> A) -> A {
        P::out_of_line(f)
    }
    fn read_words(next: &mut dyn FnMut() -> f64) -> Self {
        Self(P::read_words(next))
    }
    #[inline]
    fn epsilon() -> f64 {
        P::epsilon()
    }
    #[inline]
    fn zero() -> Self {
        Self(P::zero())
    }
    #[inline]
    fn one() -> Self {
        Self(P::one())
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = self.0.sin_cos();
        (Self(sine), Self(cosine))
    }
}

impl<P: Pack> Pack for Called<P> {
    #[inline]
    fn load(from: &[f64], missing: f64) -> Self {
        Self(P::load(from, missing))
    }
    #[inline]
    fn store(self, into: &mut [f64]) {
        self.0.store(into);
    }
    #[inline]
    fn below(n: u32) -> P::Mask {
        P::below(n)
    }
}
