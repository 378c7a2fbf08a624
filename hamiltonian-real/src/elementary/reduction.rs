//! Angles modulo π/2, for every finite number of two words.
//!
//! Input: an angle `x = high + low`. Output: the quadrant `n mod 4` and the rest `r`, |r| ≤ π/4, of
//! `x = n·π/2 + r`. Invariant: `r` has a relative error of about 2⁻¹⁰³ however large `x` is and
//! however near to a multiple of π/2.
//!
//! The method is that of M. H. Payne and R. N. Hanek (*ACM SIGNUM Newsl.* 18, 19, 1983,
//! doi:10.1145/1057600.1057602): each word of `x` is an integer times a power of two, and only
//! that window of the bits of 2/π is multiplied whose product neither is a multiple of 4 nor lies
//! below the wanted precision. Both words' products are exact integers, so their cancellation
//! costs nothing.

use super::coefficients::{HALF_PI_HIGH, HALF_PI_LOW};
use super::exact::{self, power_of_two};
use super::pairs::{ROUNDER, fast_two_sum, two_product};
use crate::two_over_pi::window;
use crate::word::{Bits, Word};

/// Words of the fixed-point number `x·2/π mod 4`, least significant first.
const WORDS: usize = 6;
/// Its bits after the point; two stand before it.
const FRACTION: usize = 64 * WORDS - 2;

/// `(n mod 4, r)` with `x = n·π/2 + r`, for finite `x = high + low`; `r` has two words as well.
pub fn reduce(high: f64, low: f64) -> (u64, (f64, f64)) {
    if high.abs() <= 0.785 {
        return (0, (high, low));
    }
    // Half a quadrant is added, so that truncation rounds to nearest.
    let mut turns = [0; WORDS];
    turns[WORDS - 1] = 1 << 61;
    add_turns(&mut turns, high);
    add_turns(&mut turns, low);

    let top = turns[WORDS - 1];
    let quadrant = top >> 62;
    // Below the middle the rest is negative; bits 61 and down are rest + ½.
    let negative = top & (1 << 61) == 0;
    turns[WORDS - 1] = top & ((1 << 61) - 1);
    if negative {
        let half = [0, 0, 0, 0, 0, 1 << 61];
        turns = sum(half, turns.map(|word| !word), true);
    }
    (quadrant, times_half_pi(to_pair(&turns), negative))
}

/// [`reduce`] for finite angles of one word from 2²⁰ on, of either sign, with a relative error of
/// about 2⁻⁶⁴; NaN if they are not finite; undefined below 2²⁰. Every operation rounds alike on
/// both sides of 0.
///
/// The angle is a whole number of 53 bits times a power of two, whose product with 2/π, modulo 4, is a sum of
/// four words ([`Word::two_over_pi`]). The first product is exact; so is its remainder modulo 8, to which the
/// others add.
#[inline(always)]
pub(super) fn reduce_large<W: Word>(angle: W) -> (W::Bits, W, W) {
    let bits = angle.bits();
    let [first, second, third, fourth] = W::two_over_pi(bits);
    // Sign and significand are kept, and the exponent is that of 2⁵².
    let kept = W::Bits::splat(1 << 63 | ((1 << 52) - 1));
    let whole = W::from_bits((bits & kept) | W::Bits::splat(TWO_TO_52.to_bits()));
    // Up to 2⁵⁴, and a multiple of 2⁻⁵⁰: so is the remainder, up to 5.
    let start = if W::FUSED {
        let eights = whole.fma(first, W::splat(EIGHTS)) - W::splat(EIGHTS);
        whole.fma(first, -eights)
    } else {
        let (product, cut) = exact_product(whole, first);
        let eights = (product + W::splat(EIGHTS)) - W::splat(EIGHTS);
        (product - eights) + cut
    };
    // Up to 4, to multiples of 2⁻¹⁰⁰.
    let (more, more_cut) = exact_product(whole, second);
    let shifted = (start + more) + W::splat(ROUNDER);
    // A multiple of 2⁻⁵⁰, which is the last place of the other addend or above it.
    let start = start - (shifted - W::splat(ROUNDER));
    let (high, high_cut) = fast_two_sum(start, more);
    // Up to 2⁻⁴⁸.
    let (less, less_cut) = exact_product(whole, third);
    let (low, low_cut) = fast_two_sum(more_cut, less);
    let least = low_cut + whole.fma(fourth, less_cut);
    // Multiples of 2⁻¹⁰⁰ and below 2⁻⁴⁷.
    let (turns, turns_cut) = fast_two_sum(high, low);
    let tail = turns_cut + (high_cut + least);
    // Quadrants to an angle.
    let (product, cut) = two_product(turns, W::splat(HALF_PI_HIGH));
    let cross = turns.fma(W::splat(HALF_PI_LOW), tail * W::splat(HALF_PI_HIGH));
    let (r, tail) = fast_two_sum(product, cut + cross);
    (shifted.bits(), r, tail)
}

const TWO_TO_52: f64 = (1u64 << 52) as f64;

/// Adding and subtracting it rounds a number up to 2⁵⁴ to a multiple of 8.
const EIGHTS: f64 = 1.5 * (1u64 << 55) as f64;

/// `a·b = p + e` exactly, for words of whole numbers below 2⁵³ and up to 2⁵², times powers of two, and to a unit
/// in the last place of `e` where both reach 2⁵³.
#[inline(always)]
fn exact_product<W: Word>(a: W, b: W) -> (W, W) {
    let p = a * b;
    if W::FUSED {
        return (p, a.fma(b, -p));
    }
    // T. J. Dekker's order of the terms, in which every sum is exact.
    let (a1, b1) = (a.cut::<27>(), b.cut::<27>());
    let (a2, b2) = (a - a1, b - b1);
    (p, (((a1 * b1 - p) + a1 * b2) + a2 * b1) + a2 * b2)
}

/// `pair·π/2`, negated on demand.
#[inline(always)]
fn times_half_pi((high, low): (f64, f64), negative: bool) -> (f64, f64) {
    let (product, error) = exact::two_product(high, HALF_PI_HIGH);
    let cross = high * HALF_PI_LOW + low * HALF_PI_HIGH;
    let (high, low) = exact::fast_two_sum(product, error + cross);
    if negative { (-high, -low) } else { (high, low) }
}

/// `(significand, scale)` with |word| = significand·2^scale.
#[inline(always)]
fn parts(word: f64) -> (u64, i32) {
    let bits = word.to_bits();
    let field = ((bits >> 52) & 0x7ff) as i32;
    let significand = (bits & ((1 << 52) - 1)) | if field > 0 { 1 << 52 } else { 0 };
    (significand, field.max(1) - 1075)
}

/// `turns += word·2/π`, modulo 4.
fn add_turns(turns: &mut [u64; WORDS], word: f64) {
    if word == 0.0 {
        return;
    }
    let (significand, scale) = parts(word);

    // Bits of 2/π worth 4 or more after scaling give multiples of 4: start after them.
    let start = (scale - 2).max(0) as usize;
    let mut product = [0u64; WORDS + 1];
    let mut carry = 0u128;
    for (i, out) in product.iter_mut().take(WORDS).enumerate() {
        let factor = window(start + 64 * (WORDS - i));
        carry += u128::from(significand) * u128::from(factor);
        *out = carry as u64;
        carry >>= 64;
    }
    product[WORDS] = carry as u64;

    let shift = (2 - scale).max(0) as usize;
    let mut term = [0; WORDS];
    for (i, out) in term.iter_mut().enumerate() {
        *out = shifted(&product, i, shift);
    }
    *turns = if word < 0.0 {
        sum(*turns, term.map(|word| !word), true)
    } else {
        sum(*turns, term, false)
    };
}

/// Word `i` of `number` shifted right by `shift` bits.
fn shifted(number: &[u64; WORDS + 1], i: usize, shift: usize) -> u64 {
    let word = |k: usize| number.get(k).copied().unwrap_or(0);
    let (words, bit) = (shift / 64, shift % 64);
    let above = if bit == 0 {
        0
    } else {
        word(i + words + 1) << (64 - bit)
    };
    word(i + words) >> bit | above
}

/// `a + b + carry` modulo 2^(64·WORDS).
fn sum(a: [u64; WORDS], b: [u64; WORDS], carry: bool) -> [u64; WORDS] {
    let mut out = [0; WORDS];
    let mut carry = u128::from(carry);
    for ((out, a), b) in out.iter_mut().zip(a).zip(b) {
        carry += u128::from(a) + u128::from(b);
        *out = carry as u64;
        carry >>= 64;
    }
    out
}

/// The fraction as a number: three words from the leading one hold at least 129 bits.
fn to_pair(fraction: &[u64; WORDS]) -> (f64, f64) {
    let leading = fraction.iter().rposition(|&word| word != 0).unwrap_or(0);
    let (mut high, mut low) = (0.0, 0.0);
    for i in (leading.saturating_sub(2)..=leading).rev() {
        let unit = power_of_two(64 * i as i32 - FRACTION as i32);
        for half in [fraction[i] >> 32 << 32, fraction[i] & 0xffff_ffff] {
            let (sum, error) = exact::two_sum(high, half as f64 * unit);
            (high, low) = exact::fast_two_sum(sum, low + error);
        }
    }
    (high, low)
}
