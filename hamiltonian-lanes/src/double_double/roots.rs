//! Square root, cube root, hypotenuse; and the sum of a power series.
//!
//! Input: double-doubles. Output: the function's value, relative error as measured in
//! `tests/double_double.rs`. Invariant: no intermediate result overflows or loses accuracy if the
//! final one is in range.

use super::DoubleDouble;
use super::arithmetic::exponent;
use hamiltonian_real::Real;
use hamiltonian_real::parts::exact::{fast_two_sum, power_of_two, two_product};

impl DoubleDouble {
    /// The square root, relative error ≤ 3.2u²; NaN below 0 (V. Lefèvre, N. Louvet, J.-M. Muller,
    /// J. Picot, L. Rideau, *ACM Trans. Math. Softw.* 49, 2023, doi:10.1145/3568672).
    #[inline]
    pub(super) fn square_root(self) -> Self {
        if !(self.hi > 0.0 && self.hi <= f64::MAX) {
            return Self::from(Real::sqrt(self.hi));
        }
        // Below, the error of the square of the root would be subnormal.
        if self.hi < 1e-270 {
            return self
                .scale(power_of_two(200))
                .square_root()
                .scale(power_of_two(-100));
        }
        // The square of the root of the largest numbers may overflow.
        if self.hi > 1e300 {
            return self
                .scale(power_of_two(-200))
                .square_root()
                .scale(power_of_two(100));
        }
        let root = Real::sqrt(self.hi);
        let (square, error) = two_product(root, root);
        let rest = ((self.hi - square) - error) + self.lo;
        let (hi, lo) = fast_two_sum(root, rest / (2.0 * root));
        Self { hi, lo }
    }

    /// The cube root: one step of Halley's iteration from the `f64` root, whose error it cubes.
    #[inline]
    pub(super) fn cube_root(self) -> Self {
        let size = self.hi.abs();
        if !(size > 0.0 && size <= f64::MAX) {
            return Self::from(Real::cbrt(self.hi));
        }
        if size < 1e-270 {
            return self
                .scale(power_of_two(198))
                .cube_root()
                .scale(power_of_two(-66));
        }
        // The cube of the root of the largest numbers may overflow.
        if size > 1e300 {
            return self
                .scale(power_of_two(-30))
                .cube_root()
                .scale(power_of_two(10));
        }
        let root = Real::cbrt(self.hi);
        let (square, error) = two_product(root, root);
        let cube = Self {
            hi: square,
            lo: error,
        }
        .mul_f64(root);
        let rest = (self - cube).hi;
        let (hi, lo) = fast_two_sum(root, root * (rest / (2.0 * self.hi + cube.hi)));
        Self { hi, lo }
    }

    /// `√(self² + other²)`; infinite where either is, even if the other is NaN.
    #[inline]
    pub(super) fn hypotenuse(self, other: Self) -> Self {
        if self.hi.is_infinite() || other.hi.is_infinite() {
            return Self::from(f64::INFINITY);
        }
        let size = self.hi.abs().max(other.hi.abs());
        if self.hi.is_nan() || other.hi.is_nan() || size == 0.0 {
            return Self::from(self.hi.abs() + other.hi.abs());
        }
        let shift = exponent(size);
        let (a, b) = (self.scale_by_power(-shift), other.scale_by_power(-shift));
        (a * a + b * b).square_root().scale_by_power(shift)
    }

    /// `Σ c_k self^k` over the coefficients of `head`, then of `tail`, by Horner's rule. The tail
    /// is summed in `f64`: its terms are below 2⁻⁵³ of the sum.
    #[inline]
    pub(super) fn series(self, head: &[(f64, f64)], tail: &[f64]) -> Self {
        let rest = tail.iter().rev().fold(0.0, |sum, c| sum * self.hi + c);
        head.iter().rev().fold(Self::from(rest), |sum, &(hi, lo)| {
            sum * self + Self { hi, lo }
        })
    }
}
