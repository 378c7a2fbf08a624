//! The four operations of double-doubles.
//!
//! Input: normalised pairs of words. Output: the same, with the relative errors stated at each
//! operation (u = 2⁻⁵³; measured bounds are in the tests). Invariant: a sum or product that is
//! infinite, NaN or −0 in `f64` is the same here: error terms of the form ∞ − ∞ are discarded.
//! Sums, products and quotients are calls, which cost 3 to 10 % of a run: inlined, a step of order
//! 8 would be half a megabyte of code.

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use hamiltonian_real::parts::exact::{fast_two_sum, power_of_two, two_product, two_sum};

use super::DoubleDouble;

/// The exponent `k` of `2^k ≤ |x| < 2^(k+1)`, for normal `x`.
#[inline(always)]
pub(super) fn exponent(x: f64) -> i32 {
    ((x.to_bits() >> 52) & 0x7ff) as i32 - 1023
}

/// `|x|/2^exponent(x)`, in [1, 2).
#[inline(always)]
pub(super) fn significand(x: f64) -> f64 {
    f64::from_bits((x.to_bits() & ((1 << 52) - 1)) | 1023 << 52)
}

impl DoubleDouble {
    /// The result `(hi, lo)` of an operation whose `f64` counterpart on the leading words is
    /// `plain`: `plain` is the result if it is infinite, NaN or a signed zero.
    #[inline(always)]
    pub(super) const fn finish(plain: f64, hi: f64, lo: f64) -> Self {
        let size = hi.abs();
        if size > 0.0 && size <= f64::MAX {
            Self { hi, lo }
        } else if size == 0.0 && plain.abs() > 0.0 && plain.abs() <= f64::MAX {
            // The trailing words cancelled the sum of the leading words.
            Self { hi: 0.0, lo: 0.0 }
        } else {
            Self { hi: plain, lo: 0.0 }
        }
    }

    /// `self·factor` for a power of two: exact, except in the subnormal range.
    #[inline(always)]
    pub(super) fn scale(self, factor: f64) -> Self {
        Self {
            hi: self.hi * factor,
            lo: self.lo * factor,
        }
    }

    /// `self·2^k` for any `k`.
    #[inline(always)]
    pub(super) fn scale_by_power(self, k: i32) -> Self {
        let half = k.clamp(-2000, 2000) / 2;
        let rest = k.clamp(-2000, 2000) - half;
        let scaled = self.scale(power_of_two(half)).scale(power_of_two(rest));
        Self::finish(scaled.hi, scaled.hi, scaled.lo)
    }

    /// `self + other`, relative error ≤ 2u².
    #[inline(always)]
    pub(super) fn add_f64(self, other: f64) -> Self {
        let (sum, error) = two_sum(self.hi, other);
        let (hi, lo) = fast_two_sum(sum, self.lo + error);
        Self::finish(sum, hi, lo)
    }

    /// `self·other`, relative error ≤ 3u².
    #[inline(always)]
    pub(super) fn mul_f64(self, other: f64) -> Self {
        let (product, error) = two_product(self.hi, other);
        let (hi, lo) = fast_two_sum(product, error + self.lo * other);
        Self::finish(product, hi, lo)
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    /// Relative error ≤ 3u² + 13u³, with cancellation too (Joldes et al. 2017, algorithm 6).
    #[inline(never)]
    fn add(self, other: Self) -> Self {
        let (sum, error) = two_sum(self.hi, other.hi);
        let (low, low_error) = two_sum(self.lo, other.lo);
        let (high, rest) = fast_two_sum(sum, error + low);
        let (hi, lo) = fast_two_sum(high, low_error + rest);
        Self::finish(sum, hi, lo)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    /// As the sum with `−other`.
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    /// Relative error ≤ 5u² (Joldes et al. 2017, algorithm 10).
    #[inline(never)]
    fn mul(self, other: Self) -> Self {
        let (product, error) = two_product(self.hi, other.hi);
        let cross = self.hi * other.lo + self.lo * other.hi;
        let (hi, lo) = fast_two_sum(product, error + cross);
        Self::finish(product, hi, lo)
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    /// Relative error ≤ 15u² (Joldes et al. 2017, algorithm 17).
    #[inline(never)]
    fn div(self, other: Self) -> Self {
        let quotient = self.hi / other.hi;
        // The remainder of a quotient that is 0 or not finite is ∞ − ∞ or 0·∞.
        if !(quotient.abs() > 0.0 && quotient.abs() <= f64::MAX && other.hi.abs() <= f64::MAX) {
            return Self {
                hi: quotient,
                lo: 0.0,
            };
        }
        let back = other.mul_f64(quotient);
        let rest = (self.hi - back.hi) + (self.lo - back.lo);
        let (hi, lo) = fast_two_sum(quotient, rest / other.hi);
        Self::finish(quotient, hi, lo)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self {
            hi: -self.hi,
            lo: -self.lo,
        }
    }
}

impl AddAssign for DoubleDouble {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for DoubleDouble {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl MulAssign for DoubleDouble {
    #[inline(always)]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl DivAssign for DoubleDouble {
    #[inline(always)]
    fn div_assign(&mut self, other: Self) {
        *self = *self / other;
    }
}
