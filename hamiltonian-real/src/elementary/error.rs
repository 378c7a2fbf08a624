//! The error function and its complement.
//!
//! Input: any double. Output: the function's value. Invariant: erfc x = exp(−x²)·P(t)/(1 + 2x) with
//! t = (x − 4)/(x + 4) (M. M. Shepherd and J. G. Laframboise, *Math. Comp.* 36, 249, 1981,
//! doi:10.2307/2007741), in which every factor keeps its second word; erf is 1 − erfc, and near 0
//! both use one polynomial.

use super::coefficients::*;
use super::exponential::{exp_parts, scale_any, scale_normal};
use super::pairs::{
    fast_two_sum, flip, is_tiny, polynomial, quotient, sign_bit, two_product, two_square, two_sum,
    unless,
};
use crate::real::Mask;
use crate::word::Word;

/// The argument from which erfc lies near or below the smallest normal number.
const LARGE: f64 = 26.0;

/// The argument up to which erf is a polynomial. Near 0 the slope of the quotient would double its
/// rounding error.
const NEAR: f64 = 0.625;

/// erfc of `NEAR ≤ x ≤ 28` as `(power, high, low)`: 2^power·(high + low).
#[inline(always)]
fn complement<W: Word>(x: W) -> (W::Bits, W, W) {
    let four = W::splat(4.0);
    let t = (x - four) / (x + four);
    let series = t.fma(
        polynomial(t, &ERROR_COMPLEMENT),
        W::splat(ERROR_COMPLEMENT_LOW),
    );
    let (p, p_cut) = fast_two_sum(W::splat(ERROR_COMPLEMENT_HIGH), series);
    let (square, square_cut) = two_square(x);
    let (power, one, rest) = exp_parts(-square, -square_cut);
    let (e, e_cut) = fast_two_sum(one, rest);
    let (n, n_cut) = two_product(p, e);
    let n_cut = p.fma(e_cut, p_cut.fma(e, n_cut));
    let (high, low) = quotient((n, n_cut), two_sum(W::one(), x + x));
    (power, high, low)
}

/// The complementary error function `1 − erf x`.
#[inline(always)]
pub fn erfc<W: Word>(x: W) -> W {
    let tiny = is_tiny(x.abs());
    let x = unless(tiny, x);
    // From there on the value is 2 to the last bit.
    let end = W::splat(-7.0);
    let size = W::select(x.lt(end), -end, x.abs());
    let (one, cut) = fast_two_sum(W::one(), -x);
    let middle = one + x.fma(-polynomial(x * x, &ERROR), cut);
    let near_0 = size.le(W::splat(NEAR));
    if W::LANES == 1 && near_0.all() {
        return middle;
    }
    let (power, high, low) = complement(size);
    let near = scale_normal(high + low, power);
    let scale = scale_normal(W::one(), power);
    let (two, cut) = fast_two_sum(W::splat(2.0), -(high * scale));
    let far = two + (cut - low * scale);
    let y = W::select(x.lt(W::zero()), far, near);
    let y = W::select(near_0, middle, y);
    y.or_rare(x.le(W::splat(LARGE)), x, erfc_of_large)
}

#[cold]
#[inline(never)]
fn erfc_of_large(x: f64) -> f64 {
    if x.is_nan() {
        x
    } else if x > 28.0 {
        0.0
    } else {
        let (power, high, low) = complement(x);
        scale_any(high + low, power)
    }
}

/// The error function `2/√π·∫₀ˣ exp(−t²) dt`: 1 to the last bit from 6 on.
#[inline(always)]
pub fn erf<W: Word>(x: W) -> W {
    let size = x.abs();
    let end = W::splat(6.0);
    let size = W::select(end.lt(size), end, size);
    let long = unless(is_tiny(size), size);
    let z = long * long;
    let near = size.fma(polynomial(z, &ERROR), size);
    let beyond = W::splat(NEAR).lt(size);
    if W::LANES == 1 && !beyond.any() {
        return flip(near, sign_bit(x));
    }
    let (power, high, low) = complement(long);
    let scale = scale_normal(W::one(), power);
    let (one, cut) = fast_two_sum(W::one(), -(high * scale));
    let far = one + (cut - low * scale);
    flip(W::select(beyond, far, near), sign_bit(x))
}
