//! `f64` and `f32` as scalars, `bool` as their mask.
//!
//! Input: IEEE 754 numbers. Output: [`Real`] for both. Invariant: nothing is fused (a product and
//! a sum are rounded apart, so the same bits on every machine), and every operator is one
//! instruction.

use crate::elementary;
use crate::elementary::root;
use crate::itself_in_lanes;
use crate::real::{Mask, Pack, Real};

impl Mask for bool {
    #[inline(always)]
    fn splat(flag: bool) -> Self {
        flag
    }
    #[inline(always)]
    fn all(self) -> bool {
        self
    }
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
    #[inline(always)]
    fn lane(self, k: u32) -> bool {
        self & (k == 0)
    }
    #[inline(always)]
    fn first(self) -> Option<u32> {
        self.then_some(0)
    }
}

impl Pack for f64 {
    #[inline(always)]
    fn load(from: &[f64], missing: f64) -> Self {
        from.first().copied().unwrap_or(missing)
    }
    #[inline(always)]
    fn store(self, into: &mut [f64]) {
        if let Some(first) = into.first_mut() {
            *first = self;
        }
    }
    #[inline(always)]
    fn below(n: u32) -> bool {
        n > 0
    }
}

/// [`Real`] for one float type, with the elementary functions given.
macro_rules! float {
    ($float:ident { $($functions:tt)* }) => {
        impl Real for $float {
            type Mask = bool;
            type Size = Self;
            const LANES: u32 = 1;

            #[inline(always)]
            fn constant(hi: f64, lo: f64) -> Self {
                // `hi + 0.0` would turn −0 into 0.
                (if lo == 0.0 { hi } else { hi + lo }) as $float
            }
            #[inline(always)]
            fn fma(self, b: Self, c: Self) -> Self {
                self * b + c
            }
            #[inline(always)]
            fn select(mask: bool, yes: Self, no: Self) -> Self {
                if mask { yes } else { no }
            }
            #[inline(always)]
            fn lt(self, other: Self) -> bool {
                self < other
            }
            #[inline(always)]
            fn le(self, other: Self) -> bool {
                self <= other
            }
            #[inline(always)]
            fn equals(self, other: Self) -> bool {
                self == other
            }
            #[inline(always)]
            fn magnitude(self) -> f64 {
                f64::from(self).abs()
            }
            #[inline(always)]
            fn size(self) -> Self {
                self.abs()
            }
            #[inline(always)]
            fn finite(self) -> bool {
                $float::is_finite(self)
            }
            #[inline(always)]
            fn look_up<const M: usize, const N: usize>(
                at: [Self; M],
                table: impl Fn([f64; M]) -> [f64; N],
            ) -> [Self; N] {
                table(at.map(f64::from)).map(|number| number as $float)
            }
            #[inline(always)]
            fn lane(self, k: u32) -> f64 {
                if k == 0 { f64::from(self) } else { f64::NAN }
            }
            #[inline(always)]
            fn epsilon() -> f64 {
                f64::from($float::EPSILON)
            }
            fn read_words(next: &mut dyn FnMut() -> f64) -> Self {
                next() as $float
            }
            #[inline(always)]
            fn abs(self) -> Self {
                $float::abs(self)
            }
            #[inline(always)]
            fn sign(self) -> Self {
                if self > 0.0 {
                    1.0
                } else if self < 0.0 {
                    -1.0
                } else {
                    // The sign of 0 is 0, and that of NaN is NaN.
                    self
                }
            }
            $($functions)*
        }
    };
}

/// The elementary functions of `f32`: those of `f64`, rounded.
macro_rules! rounded {
    ($($name:ident)*; $($two:ident)*) => {
        $(
            #[inline(always)]
            fn $name(self) -> Self {
                <f64 as Real>::$name(f64::from(self)) as f32
            }
        )*
        $(
            #[inline(always)]
            fn $two(self, other: Self) -> Self {
                <f64 as Real>::$two(f64::from(self), f64::from(other)) as f32
            }
        )*
    };
}

float! { f64 {
    type Over<P: Pack> = P;
    const WIDENS: bool = true;
    #[inline(always)]
    fn gather<P: Pack>(values: &[f64]) -> P {
        P::load(values, values.last().copied().unwrap_or_default())
    }
    #[inline(always)]
    fn scatter<P: Pack>(from: P, into: &mut [f64]) {
        from.store(into);
    }
    #[inline(always)]
    fn spread<P: Pack>(self) -> P {
        P::constant(self, 0.0)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        root::sqrt(self)
    }
    elementary! { #[inline] }
} }

float! { f32 {
    itself_in_lanes! {}
    // An f64 has more than twice the digits of an f32 and two, so rounding the root twice equals
    // rounding it once.
    rounded! { sqrt sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh exp exp_m1 ln ln_1p
        cbrt erf erfc floor round; pow hypot atan2 remainder }
    #[inline(always)]
    fn modulo(self, other: Self) -> Self {
        let rest = <f64 as Real>::modulo(f64::from(self), f64::from(other)) as f32;
        // A number below |other| may round to it.
        if rest >= other.abs() && other.is_finite() { 0.0 } else { rest }
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = <f64 as Real>::sin_cos(f64::from(self));
        (sine as f32, cosine as f32)
    }
} }
