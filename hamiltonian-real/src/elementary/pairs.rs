//! Numbers of two words: a number and its rounding error.
//!
//! Input: words. Output: `(high, low)` with |low| of the order of one unit in the last place of
//! `high`. Invariant: the sum of the two is exact where stated, whether the type fuses or not.

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

/// `a·b = p + e`, where nothing overflows and `e` is normal: exactly by one fused operation, or to
/// 2⁻⁷⁸ by Dekker's products of halves, those that cross summed first.
#[inline(always)]
pub(super) fn two_product<W: Word>(a: W, b: W) -> (W, W) {
    let p = a * b;
    if W::FUSED {
        (p, a.fma(b, -p))
    } else {
        let (a1, a2) = halves(a);
        let (b1, b2) = halves(b);
        (p, ((a1 * b1 - p) + (a1 * b2 + a2 * b1)) + a2 * b2)
    }
}

/// `a² = p + e`, as in [`two_product`], with fewer operations.
#[inline(always)]
pub(super) fn two_square<W: Word>(a: W) -> (W, W) {
    let p = a * a;
    if W::FUSED {
        (p, a.fma(a, -p))
    } else {
        let (a1, a2) = halves(a);
        (p, ((a1 * a1 - p) + (a1 + a1) * a2) + a2 * a2)
    }
}

/// `c − a·b`, where `a·b` is `c` to about a unit in the last place: exactly by one fused operation, or
/// to 2⁻⁷⁸ of `c`.
#[inline(always)]
fn remainder<W: Word>(c: W, a: W, b: W) -> W {
    if W::FUSED {
        a.fma(-b, c)
    } else {
        let (a1, a2) = halves(a);
        let (b1, b2) = halves(b);
        ((c - a1 * b1) - a1 * b2) - a2 * b
    }
}

/// `a` as a word of 26 bits and one of 27.
#[inline(always)]
fn halves<W: Word>(a: W) -> (W, W) {
    let high = a.cut::<27>();
    (high, a - high)
}

/// The quotient of two pairs, with a relative error of about 2⁻¹⁰² where the type fuses, and 2⁻⁷⁸ elsewhere.
#[inline(always)]
pub(super) fn quotient<W: Word>(a: (W, W), b: (W, W)) -> (W, W) {
    let inverse = W::one() / b.0;
    let q = a.0 * inverse;
    (q, (remainder(a.0, q, b.0) + (a.1 - q * b.1)) * inverse)
}

/// The square root of a pair, given the root of its high word; 0 if that is 0.
#[inline(always)]
pub(super) fn square_root<W: Word>(a: (W, W)) -> (W, W) {
    let root = a.0.sqrt();
    // The division runs in parallel with the root. If the root is 0, the rest is 0 too, so any
    // divisor except 0 is correct, and other lanes do not change.
    let half_inverse = W::splat(0.5) / (a.0 + W::splat(f64::MIN_POSITIVE)) * root;
    (root, (remainder(a.0, root, root) + a.1) * half_inverse)
}

/// The polynomial with the given coefficients, the lowest first, which rounds twice beside the
/// first coefficient. Pairs of terms make fours and these eights (G. Estrin, *Proc. Western Joint
/// Computer Conf.*, 33, 1960, doi:10.1145/1460361.1460365), a chain of dependent operations of a
/// third to a half of Horner's; the lowest pair comes last. Types that fuse, which are lanes, sum
/// pairs by Horner's scheme in z²: the chain is only slightly longer, and z⁴ is not needed.
#[inline(always)]
pub(super) fn polynomial<W: Word, const N: usize>(z: W, coefficients: &[f64; N]) -> W {
    let square = z * z;
    let low = two_terms(z, coefficients, 0);
    if W::FUSED {
        let mut start = (N - 1) / 2 * 2;
        let mut sum = two_terms(z, coefficients, start);
        while start > 0 {
            start -= 2;
            sum = sum.fma(square, two_terms(z, coefficients, start));
        }
        return sum;
    }
    let fourth = square * square;
    let mut sum = two_terms(z, coefficients, 2) * square;
    if N > 4 {
        sum = four_terms(z, square, coefficients, 4).fma(fourth, sum);
    }
    if N > 8 {
        let eighth = fourth * fourth;
        let mut start = (N - 1) / 8 * 8;
        let mut high = eight_terms(z, square, fourth, coefficients, start);
        while start > 8 {
            start -= 8;
            high = high.fma(eighth, eight_terms(z, square, fourth, coefficients, start));
        }
        sum = high.fma(eighth, sum);
    }
    low + sum
}

/// Up to eight terms from number `k` on, over `z^k`.
#[inline(always)]
fn eight_terms<W: Word, const N: usize>(
    z: W,
    square: W,
    fourth: W,
    coefficients: &[f64; N],
    k: usize,
) -> W {
    let low = four_terms(z, square, coefficients, k);
    if k + 4 < N {
        four_terms(z, square, coefficients, k + 4).fma(fourth, low)
    } else {
        low
    }
}

/// Up to four terms from number `k` on, over `z^k`.
#[inline(always)]
fn four_terms<W: Word, const N: usize>(z: W, square: W, coefficients: &[f64; N], k: usize) -> W {
    let low = two_terms(z, coefficients, k);
    if k + 2 < N {
        two_terms(z, coefficients, k + 2).fma(square, low)
    } else {
        low
    }
}

/// The one or two terms from number `k` on, over `z^k`.
#[inline(always)]
fn two_terms<W: Word, const N: usize>(z: W, coefficients: &[f64; N], k: usize) -> W {
    if k + 1 < N {
        W::splat(coefficients[k + 1]).fma(z, W::splat(coefficients[k]))
    } else {
        W::splat(coefficients[k])
    }
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

/// A number below 2⁵¹ plus this constant is rounded to an integer, which is in the lowest bits.
pub(super) const ROUNDER: f64 = 1.5 * (1u64 << 52) as f64;

/// The argument below which a function that is `x·(1 + c·x + …)` or `1 + c·x` at 0, with |c| ≤ ½,
/// equals its first term to the last bit.
const TINY: f64 = 1.0 / (1u64 << 60) as f64;

/// The mask of tiny `size ≥ 0`. Their squares and higher powers change no sum but may be subnormal:
/// on many CPUs an operation on a subnormal number takes a hundred times as long.
#[inline(always)]
pub(super) fn is_tiny<W: Word>(size: W) -> W::Mask {
    size.lt(W::splat(TINY))
}

/// 0 where the mask is set, `x` elsewhere.
#[inline(always)]
pub(super) fn unless<W: Word>(mask: W::Mask, x: W) -> W {
    W::select(mask, W::zero(), x)
}

/// `2⁵²·x` of a positive subnormal number, which is read as an integer.
pub(super) fn times_two_to_52(x: f64) -> f64 {
    x.to_bits() as f64 * f64::MIN_POSITIVE
}
