//! Whole numbers beside a number, and remainders.
//!
//! Input: lanes of `f64`. Output: the nearest whole number, the whole number below, `x % y` and the nearest
//! remainder. Invariant: each result is the exact one, rounded once if it is not an `f64`; so the bits are the
//! same with and without fusing. Quotients from 2²⁵ on, and divisors far from 1, are computed lane by lane.

use super::pairs::{flip, sign_bit, two_product};
use crate::word::Word;

/// Numbers from 2⁵² on are whole. A smaller number ≥ 0 plus 2⁵² is rounded to a whole number, ties to even.
const TWO_TO_52: f64 = (1u64 << 52) as f64;

/// Products of an `f64` and a whole number below 2²⁵ are exact in two words without fusing too.
const LARGE_QUOTIENT: f64 = (1u64 << 25) as f64;

/// 2⁻⁹⁰⁰ and 2⁹⁰⁰: products of such quotients with divisors between them neither overflow nor lose a word.
const DIVISORS: (f64, f64) = (
    f64::from_bits((1023 - 900) << 52),
    f64::from_bits((1023 + 900) << 52),
);

/// The nearest whole number, ties to even; keeps the sign of zero.
#[inline(always)]
pub fn round<W: Word>(x: W) -> W {
    let size = x.abs();
    let whole = (size + W::splat(TWO_TO_52)) - W::splat(TWO_TO_52);
    let whole = flip(whole, sign_bit(x));
    W::select(size.lt(W::splat(TWO_TO_52)), whole, x)
}

/// The largest whole number ≤ x; keeps the sign of zero.
#[inline(always)]
pub fn floor<W: Word>(x: W) -> W {
    let nearest = round(x);
    W::select(x.lt(nearest), nearest - W::one(), nearest)
}

/// The mask of the lanes in which x − n·y is computed from two words, for whole n next to the quotient.
#[inline(always)]
fn is_plain<W: Word>(quotient: W, size: W) -> W::Mask {
    quotient.abs().lt(W::splat(LARGE_QUOTIENT))
        & W::splat(DIVISORS.0).lt(size)
        & size.lt(W::splat(DIVISORS.1))
}

/// x − n·y, rounded once.
#[inline(always)]
fn less_multiple<W: Word>(x: W, n: W, y: W) -> W {
    let (product, error) = two_product(n, y);
    (x - product) - error
}

/// x − |y|·⌊x/|y|⌋, in [0, |y|). A remainder that rounds to |y| is 0, which is the same modulo y. NaN for y = 0
/// and infinite x.
#[inline(always)]
pub fn modulo<W: Word>(x: W, y: W) -> W {
    let size = y.abs();
    let quotient = x / size;
    let rest = less_multiple(x, floor(quotient), size);
    // A quotient that rounds up to a whole number gives a rest just below 0.
    let rest = W::select(rest.lt(W::zero()), rest + size, rest);
    let rest = W::select(size.le(rest), W::zero(), rest);
    // −0 becomes 0.
    (rest + W::zero()).or_rare2(is_plain(quotient, size), x, y, modulo_alone)
}

/// x − n·y with n the whole number nearest to x/y, ties to even: in [−|y|/2, |y|/2], the remainder of IEEE 754.
/// A zero has the sign of x. NaN for y = 0 and infinite x.
#[inline(always)]
pub fn remainder<W: Word>(x: W, y: W) -> W {
    let size = y.abs();
    let quotient = x / size;
    let rest = less_multiple(x, round(quotient), size);
    // A quotient that rounds to a tie may have the other neighbour nearer.
    let is_beyond = size.lt(rest.abs() + rest.abs());
    let rest = W::select(is_beyond, rest - flip(size, sign_bit(rest)), rest);
    let zero = W::from_bits(sign_bit(x));
    let rest = W::select(rest.equals(W::zero()), zero, rest);
    rest.or_rare2(is_plain(quotient, size), x, y, remainder_alone)
}

/// [`modulo`] of one number, for all arguments.
fn modulo_alone(x: f64, y: f64) -> f64 {
    let size = y.abs();
    let rest = x % size;
    let rest = if rest < 0.0 { rest + size } else { rest };
    // −1 % ∞ is ∞, as no smaller number is.
    if rest >= size && size < f64::INFINITY {
        0.0
    } else {
        rest + 0.0
    }
}

/// [`remainder`] of one number, for all arguments (the method of `fdlibm`, Sun Microsystems 1993: `x % 2y` is exact,
/// and at most two subtractions remain).
fn remainder_alone(x: f64, y: f64) -> f64 {
    let size = y.abs();
    if x.is_nan() || x.is_infinite() || size.is_nan() || size == 0.0 {
        return f64::NAN;
    }
    let mut rest = x.abs();
    if size <= f64::MAX / 2.0 {
        rest %= size + size;
    }
    // Halves of small divisors and doubles of large ones are exact.
    let is_beyond = |rest: f64| match size < 1.0 {
        true => rest + rest > size,
        false => rest > 0.5 * size,
    };
    let is_at_least_half = |rest: f64| match size < 1.0 {
        true => rest + rest >= size,
        false => rest >= 0.5 * size,
    };
    if is_beyond(rest) {
        rest -= size;
        if is_at_least_half(rest) {
            rest -= size;
        }
    }
    if x.is_sign_negative() { -rest } else { rest }
}
