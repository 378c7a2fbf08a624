//! Roots of a function of one variable between two points where its signs differ.
//!
//! Input: the function, its values at 0 and 1. Output: the point, to the rounding of 1, and the
//! value there. Invariant: points do not depend on dual parts of values.

use crate::errors::Error;
use hamiltonian_lanes::{Mask, Real};

/// A point of the line and the value of a function there.
#[derive(Clone, Copy)]
pub(crate) struct Sample<T> {
    pub(crate) at: T,
    pub(crate) value: T,
}

/// −1, 0, 1; 0 for NaN.
pub(crate) fn side<T: Real>(value: T) -> i8 {
    let zero = T::zero();
    i8::from(zero.lt(value).any()) - i8::from(value.lt(zero).any())
}

/// The root of `f` between `a` and `b`, whose values have different signs: inverse quadratic
/// interpolation where it is safe, bisection elsewhere (T. R. Chandrupatla, Adv. Eng. Softw. 28
/// (1997) 145, doi:10.1016/S0965-9978(96)00051-8). Returns the one
/// of the last two points with the smaller value.
///
/// # Errors
/// Those of `f`.
pub(crate) fn root<T: Real>(
    mut a: Sample<T>,
    mut b: Sample<T>,
    mut f: impl FnMut(T) -> Result<T, Error>,
) -> Result<Sample<T>, Error> {
    /// The largest number of steps: bisection alone needs one for each bit.
    const MAX_BISECTIONS: u32 = 240;
    let mut part = 0.5;
    for _ in 0..MAX_BISECTIONS {
        let at = a.at + (b.at - a.at) * T::constant(part, 0.0);
        let here = Sample { at, value: f(at)? };
        let before = if side(here.value) == side(a.value) {
            a
        } else {
            core::mem::replace(&mut b, a)
        };
        a = here;
        let best = nearer(a, b);
        let least = 2.0 * T::epsilon() / (b.at - a.at).to_f64().abs();
        if side(best.value) == 0 || least >= 0.5 {
            return Ok(best);
        }
        part = interpolated(a, b, before).unwrap_or(0.5);
        part = part.clamp(least, 1.0 - least);
    }
    Ok(nearer(a, b))
}

/// The point with the smaller value.
fn nearer<T: Real>(a: Sample<T>, b: Sample<T>) -> Sample<T> {
    if a.value.abs().lt(b.value.abs()).any() {
        a
    } else {
        b
    }
}

/// The root between `a` and `b` of the inverse parabola through three points, if it is monotonic there.
fn interpolated<T: Real>(a: Sample<T>, b: Sample<T>, c: Sample<T>) -> Option<f64> {
    let apart = |x: T, y: T| (x - y).to_f64();
    let values = |x: Sample<T>, y: Sample<T>| apart(x.value, y.value);
    let xi = apart(a.at, b.at) / apart(c.at, b.at);
    let phi = values(a, b) / values(c, b);
    let is_safe = phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi;
    let [fa, fb, fc] = [a, b, c].map(|sample| sample.value.to_f64());
    is_safe.then(|| {
        fa / values(b, a) * (fc / values(b, c))
            + apart(c.at, a.at) / apart(b.at, a.at) * (fa / values(c, a)) * (fb / values(c, b))
    })
}

/// A point between 0 and 1 at which `f` has another sign than at both ends, by golden sections
/// towards smaller sizes; `None` if the smallest value found has the sign of the ends.
///
/// # Errors
/// Those of `f`.
pub(crate) fn dip<T: Real>(
    sign: i8,
    mut f: impl FnMut(T) -> Result<T, Error>,
) -> Result<Option<Sample<T>>, Error> {
    /// (√5 − 1)/2.
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    /// A minimum is flat: beyond half the digits its position does not matter.
    const MAX_SECTIONS: u32 = 36;
    let (mut low, mut high) = (0.0, 1.0);
    let mut probe = |at: f64| {
        let at = T::constant(at, 0.0);
        f(at).map(|value| Sample { at, value })
    };
    let (mut left, mut right) = (probe(1.0 - GOLDEN)?, probe(GOLDEN)?);
    for _ in 0..MAX_SECTIONS {
        for sample in [left, right] {
            if side(sample.value) == -sign {
                return Ok(Some(sample));
            }
        }
        if left.value.abs().lt(right.value.abs()).any() {
            high = right.at.to_f64();
            right = left;
            left = probe(high - GOLDEN * (high - low))?;
        } else {
            low = left.at.to_f64();
            left = right;
            right = probe(low + GOLDEN * (high - low))?;
        }
    }
    Ok(None)
}
