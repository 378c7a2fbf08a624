//! Logarithms and inverse hyperbolic functions.
//!
//! Input: any double. Output: the function's value. Invariant: `x = 2^k·(1 + f)` with
//! 0.69 ≤ 1 + f < 1.38, and ln(1 + f) by `s = f/(2 + f)`: 2s + … = f − (f²/2 − s·(f²/2 + …)), so that
//! only a small term is rounded (the form of K. C. Ng's `log` in fdlibm, 1993). The inverse
//! hyperbolic functions take the logarithm of a number of two words.

use super::coefficients::*;
use super::pairs::{
    fast_two_sum, flip, is_tiny, polynomial, quotient, sign_bit, square_root, times_two_to_52,
    two_product, two_square, two_sum, unless,
};
use crate::real::Mask;
use crate::word::{Bits, Word};

const ONE: u64 = 1023 << 52;
const FRACTION: u64 = (1 << 52) - 1;
/// The least 1 + f, as bits.
const LEAST: u64 = LOGARITHM_LEAST.to_bits();
const TWO_TO_52: f64 = (1u64 << 52) as f64;

/// `(field, k, f)` of a positive normal `x = 2^k·(1 + f)`; `field = k + 1023`, and `f` is exact.
#[inline(always)]
pub(super) fn split<W: Word>(x: W) -> (W::Bits, W, W) {
    let shifted = x.bits().plus(W::Bits::splat(ONE - LEAST));
    let field = shifted.shr::<52>();
    let k = W::from_bits(field | W::Bits::splat(TWO_TO_52.to_bits()));
    let k = k - W::splat(TWO_TO_52 + 1023.0);
    let bits = (shifted & W::Bits::splat(FRACTION)).plus(W::Bits::splat(LEAST));
    (field, k, W::from_bits(bits) - W::one())
}

/// `k·ln 2 + ln(1 + f + more)`, with |more| below a unit in the last place of 1. The error of ln is
/// 0.83 units. An eighth coefficient would reduce it by 0.03, for 7 % more time; the form f − (f·s
/// − …) takes 5 % less time and has errors of 0.93.
#[inline(always)]
fn assemble<W: Word>(k: W, f: W, more: W) -> W {
    let s = f / (W::splat(2.0) + f);
    let z = s * s;
    let half = W::splat(0.5) * f;
    let inner = z.fma(polynomial(z, &LOGARITHM), half * f);
    // The product with k is exact, and so is the rounding error of the sum.
    let high = k.fma(W::splat(LN_2_HIGH), f);
    let cut = f + k.fma(W::splat(LN_2_HIGH), -high);
    let low = k.fma(W::splat(LN_2_LOW), more + cut);
    high + s.fma(inner, (-half).fma(f, low))
}

/// `ln(2^shift·(u + more))`, for a normal positive `u` and |more| below its last place. Near 1 the
/// relative error is small as long as `(u − 1) + more` has it.
#[inline(always)]
fn ln_of_pair<W: Word>(u: W, more: W) -> W {
    let (field, k, f) = split(u);
    let inverse_scale = W::from_bits(W::Bits::splat(2046).minus(field).shl::<52>());
    let (f, rest) = fast_two_sum(f, more * inverse_scale);
    // The derivative of the logarithm at 1 + f is 1 − f to the precision that the rest needs.
    assemble(k, f, rest - rest * f)
}

/// Natural logarithm.
#[inline(always)]
pub fn ln<W: Word>(x: W) -> W {
    let (_, k, f) = split(x);
    let y = assemble(k, f, W::zero());
    let plain = W::splat(f64::MIN_POSITIVE).le(x) & x.le(W::splat(f64::MAX));
    y.or_rare(plain, x, ln_of_rare)
}

#[cold]
#[inline(never)]
fn ln_of_rare(x: f64) -> f64 {
    if x == 0.0 {
        f64::NEG_INFINITY
    } else if x < 0.0 {
        f64::NAN
    } else if x < f64::MIN_POSITIVE {
        ln_times(times_two_to_52(x), -52.0)
    } else {
        ln_times(x, 0.0)
    }
}

/// `ln(1 + x)`: the logarithm of the rounded sum, and a term for its rounding error.
#[inline(always)]
pub fn ln_1p<W: Word>(x: W) -> W {
    let tiny = is_tiny(x.abs());
    if W::LANES == 1 && tiny.all() {
        return x;
    }
    let (u, cut) = two_sum(W::one(), unless(tiny, x));
    let y = W::select(tiny, x, ln_of_pair(u, cut));
    let plain = (-W::one()).lt(x) & x.le(W::splat(LARGE));
    if plain.all() {
        return y;
    }
    if W::LANES == 1 {
        return y.or_rare(plain, x, ln_1p_of_rare);
    }
    let y = W::select(W::splat(LARGE).lt(x), ln_of_large(x, 0.0), y);
    y.or_rare((-W::one()).lt(x), x, ln_1p_of_rare)
}

#[cold]
#[inline(never)]
fn ln_1p_of_rare(x: f64) -> f64 {
    if x == -1.0 {
        f64::NEG_INFINITY
    } else if x < -1.0 {
        f64::NAN
    } else {
        ln_times(x, 0.0)
    }
}

/// The argument beyond which squares may overflow, `1 + x` is `x` to the last bit, and `x + √(x² ±
/// 1)` is `2x`.
const LARGE: f64 = (1u128 << 100) as f64;

/// [`ln_times`] in lanes.
#[inline(always)]
fn ln_of_large<W: Word>(x: W, shift: f64) -> W {
    let (_, k, f) = split(x);
    let y = assemble(k + W::splat(shift), f, W::zero());
    W::select(x.le(W::splat(f64::MAX)), y, x)
}

/// `ln(2^shift·x)` for a positive normal `x`; `x` itself where infinite or NaN.
fn ln_times(x: f64, shift: f64) -> f64 {
    if x <= f64::MAX {
        let (_, k, f) = split(x);
        assemble(k + shift, f, 0.0)
    } else {
        x
    }
}

/// Inverse hyperbolic sine: `ln(x + √(x² + 1))`.
#[inline(always)]
pub fn asinh<W: Word>(x: W) -> W {
    let size = x.abs();
    let tiny = is_tiny(size);
    if W::LANES == 1 && tiny.all() {
        return x;
    }
    let long = unless(tiny, size);
    let (square, square_cut) = two_square(long);
    let (sum, cut) = two_sum(W::one(), square);
    let (root, root_cut) = square_root((sum, cut + square_cut));
    let (u, cut) = fast_two_sum(root, long);
    let y = flip(ln_of_pair(u, cut + root_cut), sign_bit(x));
    let y = W::select(tiny, x, y);
    let plain = size.le(W::splat(LARGE));
    if plain.all() {
        return y;
    }
    if W::LANES == 1 {
        return y.or_rare(plain, x, asinh_of_large);
    }
    W::select(plain, y, flip(ln_of_large(size, 1.0), sign_bit(x)))
}

#[cold]
#[inline(never)]
fn asinh_of_large(x: f64) -> f64 {
    flip(ln_times(x.abs(), 1.0), sign_bit(x))
}

/// Inverse hyperbolic cosine: `ln(x + √(x² − 1))`.
#[inline(always)]
pub fn acosh<W: Word>(x: W) -> W {
    let (square, square_cut) = two_square(x);
    let (difference, cut) = fast_two_sum(square, -W::one());
    let (root, root_cut) = square_root((difference, cut + square_cut));
    let (u, cut) = fast_two_sum(x, root);
    let y = ln_of_pair(u, cut + root_cut);
    let plain = W::one().le(x) & x.le(W::splat(LARGE));
    if plain.all() {
        return y;
    }
    if W::LANES == 1 {
        return y.or_rare(plain, x, acosh_of_rare);
    }
    let y = W::select(W::splat(LARGE).lt(x), ln_of_large(x, 1.0), y);
    y.or_rare(W::one().le(x), x, acosh_of_rare)
}

#[cold]
#[inline(never)]
fn acosh_of_rare(x: f64) -> f64 {
    if x < 1.0 { f64::NAN } else { ln_times(x, 1.0) }
}

/// Inverse hyperbolic tangent: `½·ln(1 + 2x/(1 − x))`.
#[inline(always)]
pub fn atanh<W: Word>(x: W) -> W {
    let size = x.abs();
    let tiny = is_tiny(size);
    if W::LANES == 1 && tiny.all() {
        return x;
    }
    let long = unless(tiny, size);
    let below = fast_two_sum(W::one(), -long);
    let (q, q_cut) = quotient((long + long, W::zero()), below);
    let (u, cut) = two_sum(W::one(), q);
    let y = W::splat(0.5) * ln_of_pair(u, cut + q_cut);
    let y = W::select(tiny, x, flip(y, sign_bit(x)));
    y.or_rare(size.lt(W::one()), x, atanh_of_rare)
}

#[cold]
#[inline(never)]
fn atanh_of_rare(x: f64) -> f64 {
    if x.abs() == 1.0 {
        flip(f64::INFINITY, sign_bit(x))
    } else {
        f64::NAN
    }
}

/// `ln x` of two words to about 2⁻⁶⁵, for a positive normal `x`, and `shift·ln 2` more: 2s + ⅔s³ +
/// s⁵·P(s²), the first two terms and their sums exactly. The error of `s` is multiplied by the
/// derivative 2/(1 − s²), since only the sum depends on it.
#[inline(always)]
pub(super) fn ln_pair<W: Word>(x: W, shift: W) -> (W, W) {
    let (_, k, f) = split(x);
    let k = k + shift;
    let (s, s_cut) = quotient((f, W::zero()), fast_two_sum(W::splat(2.0), f));
    let two = W::splat(2.0);
    let (z, z_cut) = two_square(s);
    let slope = z.fma(z.fma(two, two), two);
    let (cube, cube_cut) = two_product(z, s);
    let cube_cut = z_cut.fma(s, cube_cut);
    let thirds = W::splat(2.0 / 3.0);
    let (t, t_cut) = two_product(cube, thirds);
    let t_cut = cube_cut.fma(thirds, cube.fma(W::splat(TWO_THIRDS_LOW), t_cut));
    let (high, cut) = fast_two_sum(k * W::splat(LN_2_HIGH), s + s);
    let (high, more) = fast_two_sum(high, t);
    let low = k.fma(W::splat(LN_2_LOW), s_cut.fma(slope, t_cut + (cut + more)));
    let low = (cube * z).fma(polynomial(z, &LOGARITHM_TAIL), low);
    fast_two_sum(high, low)
}
