//! Exponential, logarithm, hyperbolic functions, their inverses, and powers.
//!
//! Input: a double-double. Output: the function's value, relative error as measured in
//! `tests/double_double.rs`. Invariant: a function that is 0 at 0 is relatively accurate near it and keeps
//! the sign of zero; overflow gives infinity, underflow 0, a point outside the domain NaN.
//!
//! exp: `x = k·ln 2 + r` with ln 2 in three words, so that the reduction costs no accuracy, then
//! the Taylor series of `exp r − 1`. ln: `x = m·2^k` with m about 1, and
//! `ln m = 2 artanh((m − 1)/(m + 1))` by its series, which needs no exponential.

use super::DoubleDouble;
use super::arithmetic::{exponent, significand};
use super::constants::{
    ATANH, ATANH_TAIL, EXP, EXP_TAIL, LN_2, LN_2_FIRST, LN_2_SECOND, LN_2_THIRD,
};
use hamiltonian_real::Real;

const ZERO: DoubleDouble = DoubleDouble { hi: 0.0, lo: 0.0 };
const ONE: DoubleDouble = DoubleDouble { hi: 1.0, lo: 0.0 };
const TWO: DoubleDouble = DoubleDouble { hi: 2.0, lo: 0.0 };
const NAN: DoubleDouble = DoubleDouble {
    hi: f64::NAN,
    lo: 0.0,
};
const INFINITY: DoubleDouble = DoubleDouble {
    hi: f64::INFINITY,
    lo: 0.0,
};

/// The argument from which `exp(−2x)` is below half a unit of the last place.
const LARGE_EXPONENT: f64 = 40.0;
/// The argument from which `1/x²` is below half a unit of the last place.
const LARGE_ARGUMENT: f64 = 1e17;

impl DoubleDouble {
    /// Exponential.
    pub(super) fn exponential(self) -> Self {
        self.scaled_exponential(0)
    }

    /// `exp(self)·2^power`, which may be finite where the exponential is not.
    fn scaled_exponential(self, power: i32) -> Self {
        if self.hi.is_nan() {
            return self;
        }
        if self.hi.abs() > 800.0 {
            return if self.hi > 0.0 { INFINITY } else { ZERO };
        }
        let k = round(self.hi / LN_2.hi);
        // The first two products are exact: k has 11 bits, its factors 42.
        let r = self
            .add_f64(-k * LN_2_FIRST)
            .add_f64(-k * LN_2_SECOND)
            .add_f64(-k * LN_2_THIRD);
        (ONE + exponential_less_one_series(r)).scale_by_power(k as i32 + power)
    }

    /// `exp(self) − 1`.
    pub(super) fn exponential_less_one(self) -> Self {
        if self.hi.abs() <= 0.346 {
            exponential_less_one_series(self)
        } else {
            self.exponential().add_f64(-1.0)
        }
    }

    /// Natural logarithm.
    pub(super) fn logarithm(self) -> Self {
        let hi = self.hi;
        if hi == 0.0 {
            return -INFINITY;
        }
        if hi < 0.0 {
            return NAN;
        }
        if !hi.is_finite() {
            return self;
        }
        // Subnormal numbers have no exponent of their own.
        let lift = if hi < 1e-300 { 200 } else { 0 };
        let lifted = self.scale_by_power(lift);
        let mut k = exponent(lifted.hi);
        if significand(lifted.hi) > core::f64::consts::SQRT_2 {
            k += 1;
        }
        let m = lifted.scale_by_power(-k);
        let near = logarithm_of_ratio(m.add_f64(-1.0), m.add_f64(1.0));
        LN_2.mul_f64(f64::from(k - lift)) + near
    }

    /// `ln(1 + self)`.
    pub(super) fn logarithm_of_one_plus(self) -> Self {
        if self.hi == 0.0 {
            self
        } else if self.hi > -0.25 && self.hi < 0.4 {
            logarithm_of_ratio(self, self.add_f64(2.0))
        } else {
            self.add_f64(1.0).logarithm()
        }
    }

    /// Hyperbolic sine.
    pub(super) fn hyperbolic_sine(self) -> Self {
        self.odd(|x| {
            if x.hi > LARGE_EXPONENT {
                return x.scaled_exponential(-1);
            }
            let e = x.exponential_less_one();
            (e + e / e.add_f64(1.0)).scale(0.5)
        })
    }

    /// Hyperbolic cosine.
    pub(super) fn hyperbolic_cosine(self) -> Self {
        let x = self.absolute();
        if x.hi > LARGE_EXPONENT {
            return x.scaled_exponential(-1);
        }
        let e = x.exponential();
        (e + ONE / e).scale(0.5)
    }

    /// Hyperbolic tangent.
    pub(super) fn hyperbolic_tangent(self) -> Self {
        self.odd(|x| {
            if x.hi > LARGE_EXPONENT {
                return ONE;
            }
            let e = x.scale(2.0).exponential_less_one();
            e / e.add_f64(2.0)
        })
    }

    /// Inverse hyperbolic sine.
    pub(super) fn area_sine(self) -> Self {
        self.odd(|x| {
            if x.hi > LARGE_ARGUMENT {
                return x.logarithm() + LN_2;
            }
            let square = x * x;
            let root = square.add_f64(1.0).square_root();
            (x + square / root.add_f64(1.0)).logarithm_of_one_plus()
        })
    }

    /// Inverse hyperbolic cosine.
    pub(super) fn area_cosine(self) -> Self {
        if self.hi < 1.0 {
            return NAN;
        }
        if self.hi > LARGE_ARGUMENT {
            return self.logarithm() + LN_2;
        }
        let x = self.add_f64(-1.0);
        (x + (x * x.add_f64(2.0)).square_root()).logarithm_of_one_plus()
    }

    /// Inverse hyperbolic tangent.
    pub(super) fn area_tangent(self) -> Self {
        self.odd(|x| {
            (x.scale(2.0) / (ONE - x))
                .logarithm_of_one_plus()
                .scale(0.5)
        })
    }

    /// `self^y`: products for small integers y, else `exp(y·ln self)`; special cases as IEEE
    /// 754's pow.
    pub(super) fn power(self, y: Self) -> Self {
        if y.hi == 0.0 || self == ONE {
            return ONE;
        }
        if self.hi.is_nan() || y.hi.is_nan() {
            return NAN;
        }
        let base = self.absolute();
        if y.hi.is_infinite() {
            return match (base > ONE, y.hi > 0.0) {
                _ if base == ONE => ONE,
                (true, true) | (false, false) => INFINITY,
                _ => ZERO,
            };
        }
        let kind = Exponent::of(y);
        if base.hi == 0.0 || base.hi.is_infinite() {
            // Only the sign and the kind of y matter.
            let like = match kind {
                Exponent::Odd => 1.0,
                Exponent::Even => 2.0,
                Exponent::Fraction => 0.5,
            };
            return Self::from(Real::pow(self.hi, if y.hi < 0.0 { -like } else { like }));
        }
        let negative = self.hi < 0.0;
        if negative && kind == Exponent::Fraction {
            return NAN;
        }
        let size = base
            .integer_power(y)
            .unwrap_or_else(|| (y * base.logarithm()).exponential());
        if negative && kind == Exponent::Odd {
            -size
        } else {
            size
        }
    }

    /// `self^y` by repeated squaring for integers |y| ≤ 32, where neither the power nor its
    /// reciprocal leaves the range.
    fn integer_power(self, y: Self) -> Option<Self> {
        let mut rest = y.hi.abs() as u32;
        if y.lo != 0.0 || y.hi.abs() > 32.0 || f64::from(rest) != y.hi.abs() {
            return None;
        }
        let (mut power, mut square) = (ONE, self);
        loop {
            if rest & 1 == 1 {
                power *= square;
            }
            rest >>= 1;
            if rest == 0 {
                break;
            }
            square *= square;
        }
        let power_in_range = power.hi > 1e-270 && power.hi < 1e300;
        power_in_range.then(|| if y.hi < 0.0 { ONE / power } else { power })
    }

    /// Absolute value.
    #[inline(always)]
    pub(super) fn absolute(self) -> Self {
        if self.hi.is_sign_negative() {
            -self
        } else {
            self
        }
    }

    /// An odd function from its values for positive arguments; 0 at 0.
    #[inline(always)]
    fn odd(self, positive: impl Fn(Self) -> Self) -> Self {
        if self.hi == 0.0 {
            self
        } else if self.hi < 0.0 {
            -positive(-self)
        } else {
            positive(self)
        }
    }
}

/// Kinds of exponents, which decide the sign of a power of a negative base.
#[derive(Clone, Copy, PartialEq)]
enum Exponent {
    Even,
    Odd,
    Fraction,
}

impl Exponent {
    /// The kind of a finite exponent. A word of 2⁵³ or more is an even integer (one of 2⁵³ and
    /// more has a unit of 2), so the next word decides.
    fn of(y: DoubleDouble) -> Self {
        const ALL_EVEN: f64 = 9_007_199_254_740_992.0;
        let word = if y.hi.abs() >= ALL_EVEN { y.lo } else { y.hi };
        if word.abs() >= ALL_EVEN {
            return Self::Even;
        }
        let integer = word as i64;
        // Below 2⁵³ the trailing word of an integer is 0.
        let has_fraction = integer as f64 != word || (word == y.hi && y.lo != 0.0);
        match (has_fraction, integer & 1 == 0) {
            (true, _) => Self::Fraction,
            (false, true) => Self::Even,
            (false, false) => Self::Odd,
        }
    }
}

/// `exp(x) − 1` for |x| ≤ ½ ln 2.
fn exponential_less_one_series(x: DoubleDouble) -> DoubleDouble {
    if x.hi == 0.0 {
        return x;
    }
    x + x * (x * x.series(&EXP, &EXP_TAIL))
}

/// `ln((sum + difference)/(sum − difference))`, for a ratio within √2 of 1: with `m − 1` and
/// `m + 1` it is ln m.
fn logarithm_of_ratio(difference: DoubleDouble, sum: DoubleDouble) -> DoubleDouble {
    let z = difference / sum;
    let square = z * z;
    (z + z * (square * square.series(&ATANH, &ATANH_TAIL))).scale(TWO.hi)
}

/// The nearest integer, for |x| < 2⁵¹.
#[inline(always)]
fn round(x: f64) -> f64 {
    // At 1.5·2⁵² the unit in the last place is 1.
    const SHIFT: f64 = 6_755_399_441_055_744.0;
    (x + SHIFT) - SHIFT
}
