//! The error function and its complement.
//!
//! Input: a double-double. Output: the function's value, relative error as measured in
//! `tests/double_double.rs`. Invariant: erf is odd and relatively accurate near 0, erfc where it is
//! small.
//!
//! Up to 1 the series `erf x = 2/√π·exp(−x²)·Σ 2ⁿx²ⁿ⁺¹/(1·3·…·(2n+1))`, all of whose terms are
//! positive; beyond it the continued fraction
//! `erfc x = exp(−x²)/√π / (x + (1/2)/(x + (2/2)/(x + (3/2)/(x + …))))` (M. Abramowitz and I. A.
//! Stegun, *Handbook of Mathematical Functions*, 7.1.6 and 7.1.14).

use super::DoubleDouble;
use hamiltonian_real::Real;
use hamiltonian_real::parts::exact::two_product;

const ZERO: DoubleDouble = DoubleDouble { hi: 0.0, lo: 0.0 };
const ONE: DoubleDouble = DoubleDouble { hi: 1.0, lo: 0.0 };
const TWO: DoubleDouble = DoubleDouble { hi: 2.0, lo: 0.0 };
/// 1/√π.
const FRAC_1_SQRT_PI: DoubleDouble = DoubleDouble {
    hi: 0.5641895835477563,
    lo: 7.66772980658294e-18,
};

/// The argument beyond which the continued fraction is used.
const SERIES_END: f64 = 1.0;
/// The argument beyond which erfc is 0 to the last bit of the smallest number.
const END: f64 = 28.0;

impl DoubleDouble {
    /// Error function.
    pub(super) fn error_function(self) -> Self {
        if self.hi == 0.0 || self.hi.is_nan() {
            self
        } else if self.hi.abs() <= SERIES_END {
            self.error_series()
        } else {
            let size = ONE - self.absolute().error_fraction();
            if self.hi < 0.0 { -size } else { size }
        }
    }

    /// Complementary error function.
    pub(super) fn error_function_complement(self) -> Self {
        if self.hi.is_nan() {
            self
        } else if self.hi < -SERIES_END {
            TWO - self.absolute().error_fraction()
        } else if self.hi <= 0.5 {
            ONE - self.error_series()
        } else {
            self.error_fraction()
        }
    }

    /// erf by its series.
    fn error_series(self) -> Self {
        let twice_square = self * self * TWO;
        let mut term = self;
        let mut sum = self;
        let mut odd = 1.0;
        while term.hi.abs() > 1e-33 * sum.hi.abs() {
            odd += 2.0;
            term = term * twice_square / Self::from(odd);
            sum += term;
        }
        TWO * FRAC_1_SQRT_PI * self.bell() * sum
    }

    /// erfc of a positive number by its continued fraction.
    fn error_fraction(self) -> Self {
        if self.hi > END {
            return ZERO;
        }
        // The error falls as exp(−2x·√(2n)).
        let half = 40.0 / self.hi;
        let mut n = (half * half * 0.5) as u32 + 16;
        let mut below = self;
        while n > 0 {
            below = self + Self::from(f64::from(n) * 0.5) / below;
            n -= 1;
        }
        self.bell() * FRAC_1_SQRT_PI / below
    }

    /// `exp(−self²)`. The square's rounding would cost as many bits as it has before the point:
    /// its leading word is exact, and the rest is a small exponent of its own.
    fn bell(self) -> Self {
        let (square, cut) = two_product(self.hi, self.hi);
        let (cross, cross_cut) = two_product(2.0 * self.hi, self.lo);
        let rest = Self::new(cut, cross) + Self::from(cross_cut + self.lo * self.lo);
        Self::from(-square).exp() * (-rest).exp()
    }
}
