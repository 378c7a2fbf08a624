//! Whole numbers beside a double-double, and remainders.
//!
//! Input: double-doubles. Output: the whole number below, the nearest one, and remainders. Invariant: whole numbers
//! are exact; a remainder of x has an error of a unit in the last place of x.

use super::DoubleDouble;
use hamiltonian_real::Real;

/// Returns true if a whole number is odd.
fn is_odd(whole: f64) -> bool {
    whole % 2.0 != 0.0
}

impl DoubleDouble {
    /// The largest whole number ≤ self.
    pub(super) fn whole_below(self) -> Self {
        let below = Real::floor(self.hi);
        if below != self.hi {
            return Self::from(below);
        }
        Self::finish(below, below, 0.0).add_f64(Real::floor(self.lo))
    }

    /// The nearest whole number, ties to even.
    pub(super) fn nearest_whole(self) -> Self {
        let nearest = Real::round(self.hi);
        if nearest == self.hi {
            let rest = Real::round(self.lo);
            let is_tie = (self.lo - rest).abs() == 0.5;
            // `rest` is even, so an odd leading word has its other neighbour.
            let rest = match is_tie && is_odd(nearest) {
                true => rest + 2.0 * (self.lo - rest),
                false => rest,
            };
            return Self::from(nearest).add_f64(rest);
        }
        // In the middle between two whole numbers the trailing word decides.
        let apart = self.hi - nearest;
        let step = match apart.abs() == 0.5 && self.lo * apart > 0.0 {
            true => 2.0 * apart,
            false => 0.0,
        };
        Self::from(nearest + step)
    }

    /// self − |other|·⌊self/|other|⌋, in [0, |other|).
    pub(super) fn modulo_of(self, other: Self) -> Self {
        let size = other.absolute();
        let rest = self - size * (self / size).whole_below();
        let rest = if rest < Self::from(0.0) {
            rest + size
        } else {
            rest
        };
        if rest >= size {
            return Self::from(0.0);
        }
        rest
    }

    /// self − n·other with n the whole number nearest to self/other.
    pub(super) fn nearest_remainder(self, other: Self) -> Self {
        self - other * (self / other).nearest_whole()
    }
}
