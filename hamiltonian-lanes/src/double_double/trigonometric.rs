//! Sine, cosine, tangent and their inverses.
//!
//! Input: a double-double. Output: the function's value, relative error as measured in
//! `tests/double_double.rs`. Invariant: odd functions keep the sign of zero; outside the domain
//! and at infinity the result is NaN.
//!
//! The angle is reduced to |r| ≤ π/4 (`reduction`), then Taylor series, whose late terms need one
//! word only. The inverses are one Newton step of [`DoubleDouble`] from the `f64` angle, as in Y.
//! Hida, X. S. Li, D. H. Bailey, *Proc. 15th IEEE Symp. Computer Arithmetic*, 155, 2001,
//! doi:10.1109/ARITH.2001.930115; taking it on the circle serves all quadrants alike.

use super::DoubleDouble;
use super::arithmetic::exponent;
use super::constants::{FRAC_3_PI_4, FRAC_PI_2, FRAC_PI_4, PI};
use hamiltonian_real::Real;
use hamiltonian_real::parts::reduce;
use hamiltonian_real::parts::series::{COS, COS_TAIL, SIN, SIN_TAIL};

const ONE: DoubleDouble = DoubleDouble { hi: 1.0, lo: 0.0 };
const NAN: DoubleDouble = DoubleDouble {
    hi: f64::NAN,
    lo: 0.0,
};

impl DoubleDouble {
    /// Sine and cosine.
    pub(super) fn sine_cosine(self) -> (Self, Self) {
        if !self.hi.is_finite() {
            return (NAN, NAN);
        }
        let (quadrant, (hi, lo)) = reduce(self.hi, self.lo);
        let r = Self { hi, lo };
        let (sin, cos) = sine_cosine_series(r);
        match quadrant {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        }
    }

    /// Tangent.
    pub(super) fn tangent(self) -> Self {
        let (sin, cos) = self.sine_cosine();
        sin / cos
    }

    /// The angle of the point (`x`, `self`), zeros and infinities as IEEE 754's atan2.
    pub(super) fn angle(self, x: Self) -> Self {
        let y = self;
        if y.hi.is_nan() || x.hi.is_nan() {
            return NAN;
        }
        if y.hi == 0.0 || x.hi == 0.0 || y.hi.is_infinite() || x.hi.is_infinite() {
            return axis_angle(y.hi, x.hi);
        }
        let (height, width) = (exponent(y.hi), exponent(x.hi));
        if x.hi > 0.0 && height < width - 60 {
            // The quotient to 120 bits, rounded once where it is subnormal.
            let quotient = y.scale_by_power(-height) / x.scale_by_power(-width);
            return quotient.scale_by_power(height - width);
        }
        // Scaled, so that the products neither overflow nor lose their low words.
        let shift = -height.max(width);
        let (y, x) = (y.scale_by_power(shift), x.scale_by_power(shift));
        let start = Real::atan2(y.hi, x.hi);
        let (sin, cos) = Self::from(start).sine_cosine();
        // The point turned back by the angle `start` lies almost on the positive axis.
        let rest = (y * cos - x * sin) / (x * cos + y * sin);
        if rest.hi == 0.0 {
            Self::from(start)
        } else {
            Self::from(start) + rest
        }
    }

    /// Arc tangent.
    pub(super) fn arc_tangent(self) -> Self {
        self.angle(ONE)
    }

    /// Arc sine.
    pub(super) fn arc_sine(self) -> Self {
        self.angle(self.cosine_of_arc_sine())
    }

    /// Arc cosine.
    pub(super) fn arc_cosine(self) -> Self {
        self.cosine_of_arc_sine().angle(self)
    }

    /// `√(1 − x²)` without cancellation near ±1.
    fn cosine_of_arc_sine(self) -> Self {
        ((ONE - self) * (ONE + self)).square_root()
    }
}

/// Sine and cosine for |x| ≤ π/4.
fn sine_cosine_series(x: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    if x.hi == 0.0 {
        return (x, ONE);
    }
    // In powers of −x² all coefficients are positive.
    let z = -(x * x);
    let sin = x + x * (z * z.series(&SIN, &SIN_TAIL));
    let cos = ONE + z * z.series(&COS, &COS_TAIL);
    (sin, cos)
}

/// The angle of a point with a coordinate that is 0 or infinite: a multiple of π/4.
fn axis_angle(y: f64, x: f64) -> DoubleDouble {
    let zero = DoubleDouble::from(0.0);
    let size = if y == 0.0 || x.is_infinite() && !y.is_infinite() {
        if x.is_sign_negative() { PI } else { zero }
    } else if x.is_infinite() {
        if x < 0.0 { FRAC_3_PI_4 } else { FRAC_PI_4 }
    } else {
        FRAC_PI_2
    };
    if y.is_sign_negative() { -size } else { size }
}
