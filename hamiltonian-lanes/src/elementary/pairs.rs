//! Numbers of two words: what rounding cuts off, kept.
//!
//! Input: words. Output: `(high, low)` with |low| of the order of one unit in the last place of
//! `high`. Invariant: the sum of the two is exact where stated, whether the type fuses or not.

use crate::real::Real;
use crate::word::{Bits, Word};

/// `a + b = s + e` exactly, where |a| ≥ |b|, a = 0 or `a` is a multiple of `b`'s last place (T. J.
/// Dekker, *Numer. Math.* 18, 224, 1971, doi:10.1007/BF01397083).
#[inline(always)]
pub(super) fn fast_two_sum<W: Word>(a: W, b: W) -> (W, W) {
    let s = a + b;
    (s, b - (s - a))
}

/// `a + b = s + e` exactly (D. E. Knuth, *The Art of Computer Programming* 2, §4.2.2, theorem B).
#[inline(always)]
pub(super) fn two_sum<W: Word>(a: W, b: W) -> (W, W) {
    let s = a + b;
    let t = s - a;
    (s, (a - (s - t)) + (b - t))
}

/// `a·b = p + e` exactly, where nothing overflows and `e` is normal: by one fused operation, or by
/// Dekker's products of halves.
#[inline(always)]
pub(super) fn two_product<W: Word>(a: W, b: W) -> (W, W) {
    let p = a * b;
    if W::FUSED {
        (p, a.fma(b, -p))
    } else {
        let (a1, a2) = halves(a);
        let (b1, b2) = halves(b);
        (p, (((a1 * b1 - p) + a1 * b2) + a2 * b1) + a2 * b2)
    }
}

/// `a` as two words of 26 bits, rounded in place.
#[inline(always)]
fn halves<W: Word>(a: W) -> (W, W) {
    let rounded = a.bits().plus(W::Bits::splat(1 << 26)) & W::Bits::splat(!((1 << 27) - 1));
    let high = W::from_bits(rounded);
    (high, a - high)
}

/// The quotient of two pairs, with a relative error of about 2⁻¹⁰².
#[inline(always)]
pub(super) fn quotient<W: Word>(a: (W, W), b: (W, W)) -> (W, W) {
    let inverse = W::one() / b.0;
    let q = a.0 * inverse;
    let (p, e) = two_product(q, b.0);
    (q, (((a.0 - p) - e) + (a.1 - q * b.1)) * inverse)
}

/// The square root of a pair, of its high word `root` and the rest; 0 where that is 0.
#[inline(always)]
pub(super) fn square_root<W: Word>(a: (W, W)) -> (W, W) {
    let root = a.0.sqrt();
    let (p, e) = two_product(root, root);
    // Where the root is 0 so is the rest: any divisor but 0 serves.
    let divisor = Real::max(root + root, W::splat(f64::MIN_POSITIVE));
    (root, (((a.0 - p) - e) + a.1) / divisor)
}

/// The polynomial with the given coefficients, the lowest first: Horner's scheme in z² over pairs of
/// terms, which halves the chain of dependent operations and rounds twice beside the first
/// coefficient.
#[inline(always)]
pub(super) fn polynomial<W: Word, const N: usize>(z: W, coefficients: &[f64; N]) -> W {
    let square = z * z;
    let mut start = (N - 1) / 2 * 2;
    let mut sum = if start == N - 1 {
        W::splat(coefficients[start])
    } else {
        two_terms(z, coefficients, start)
    };
    while start > 0 {
        start -= 2;
        sum = sum.fma(square, two_terms(z, coefficients, start));
    }
    sum
}

/// The terms number `k` and `k + 1`, over `z^k`.
#[inline(always)]
fn two_terms<W: Word, const N: usize>(z: W, coefficients: &[f64; N], k: usize) -> W {
    W::splat(coefficients[k + 1]).fma(z, W::splat(coefficients[k]))
}

/// The sign bit of each lane.
#[inline(always)]
pub(super) fn sign_bit<W: Word>(x: W) -> W::Bits {
    x.bits() & W::Bits::splat(1 << 63)
}

/// `x` with the given sign bits flipped.
#[inline(always)]
pub(super) fn flip<W: Word>(x: W, signs: W::Bits) -> W {
    W::from_bits(x.bits() ^ signs)
}

/// Added to a number below 2⁵¹ it rounds it to an integer, which the lowest bits then hold.
pub(super) const ROUNDER: f64 = 1.5 * (1u64 << 52) as f64;
