//! [`Real`] for double-doubles, by the functions of this folder.
//!
//! Input: the functions beside this file. Output: the trait. Invariant: comparisons order by the
//! leading word, then by the trailing one; NaN compares false.

use super::DoubleDouble;
use hamiltonian_real::{Parameter, Real, itself_in_lanes};

impl Parameter for DoubleDouble {
    #[inline(always)]
    fn into_real<T: Real>(self) -> T {
        T::constant(self.hi(), self.lo())
    }
}

impl Real for DoubleDouble {
    type Mask = bool;
    type Size = f64;
    const LANES: u32 = 1;
    itself_in_lanes! {}

    #[inline(always)]
    fn constant(hi: f64, lo: f64) -> Self {
        if lo == 0.0 {
            Self::from(hi)
        } else {
            Self::new(hi, lo)
        }
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
        self.hi.abs()
    }
    #[inline(always)]
    fn size(self) -> f64 {
        self.hi.abs()
    }
    #[inline(always)]
    fn finite(self) -> bool {
        self.hi.is_finite()
    }
    fn write_words(self, to: &mut dyn FnMut(f64)) {
        to(self.hi);
        to(self.lo);
    }
    fn read_words(next: &mut dyn FnMut() -> f64) -> Self {
        Self {
            hi: next(),
            lo: next(),
        }
    }
    #[inline(always)]
    fn look_up<const M: usize, const N: usize>(
        at: [Self; M],
        table: impl Fn([f64; M]) -> [f64; N],
    ) -> [Self; N] {
        table(at.map(|x| x.hi)).map(Self::from)
    }
    #[inline(always)]
    fn lane(self, k: u32) -> f64 {
        if k == 0 { self.hi } else { f64::NAN }
    }
    #[inline(always)]
    fn epsilon() -> f64 {
        // 2⁻¹⁰⁵: two words of 53 bits.
        f64::EPSILON * f64::EPSILON * 0.5
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.absolute()
    }
    #[inline(always)]
    fn sign(self) -> Self {
        Self::from(self.hi.sign())
    }
    #[inline(always)]
    fn floor(self) -> Self {
        self.whole_below()
    }
    #[inline(always)]
    fn round(self) -> Self {
        self.nearest_whole()
    }
    #[inline(always)]
    fn modulo(self, other: Self) -> Self {
        self.modulo_of(other)
    }
    #[inline(always)]
    fn remainder(self, other: Self) -> Self {
        self.nearest_remainder(other)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.square_root()
    }
    #[inline(always)]
    fn cbrt(self) -> Self {
        self.cube_root()
    }
    #[inline(always)]
    fn sin(self) -> Self {
        self.sine_cosine().0
    }
    #[inline(always)]
    fn cos(self) -> Self {
        self.sine_cosine().1
    }
    #[inline(always)]
    fn tan(self) -> Self {
        self.tangent()
    }
    #[inline(always)]
    fn asin(self) -> Self {
        self.arc_sine()
    }
    #[inline(always)]
    fn acos(self) -> Self {
        self.arc_cosine()
    }
    #[inline(always)]
    fn atan(self) -> Self {
        self.arc_tangent()
    }
    #[inline(always)]
    fn sinh(self) -> Self {
        self.hyperbolic_sine()
    }
    #[inline(always)]
    fn cosh(self) -> Self {
        self.hyperbolic_cosine()
    }
    #[inline(always)]
    fn tanh(self) -> Self {
        self.hyperbolic_tangent()
    }
    #[inline(always)]
    fn asinh(self) -> Self {
        self.area_sine()
    }
    #[inline(always)]
    fn acosh(self) -> Self {
        self.area_cosine()
    }
    #[inline(always)]
    fn atanh(self) -> Self {
        self.area_tangent()
    }
    #[inline(always)]
    fn exp(self) -> Self {
        self.exponential()
    }
    #[inline(always)]
    fn exp_m1(self) -> Self {
        self.exponential_less_one()
    }
    #[inline(always)]
    fn ln(self) -> Self {
        self.logarithm()
    }
    #[inline(always)]
    fn ln_1p(self) -> Self {
        self.logarithm_of_one_plus()
    }
    #[inline(always)]
    fn erf(self) -> Self {
        self.error_function()
    }
    #[inline(always)]
    fn erfc(self) -> Self {
        self.error_function_complement()
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        self.sine_cosine()
    }
    #[inline(always)]
    fn atan2(self, other: Self) -> Self {
        self.angle(other)
    }
    #[inline(always)]
    fn hypot(self, other: Self) -> Self {
        self.hypotenuse(other)
    }
    #[inline(always)]
    fn pow(self, exponent: Self) -> Self {
        self.power(exponent)
    }
}
