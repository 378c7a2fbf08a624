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
use crate::word::{Bits, Word};

/// 64 bits before the point and 1536 bits of 2/π, the most significant first.
#[rustfmt::skip]
const TWO_OVER_PI: [u64; 25] = [
    0,
    0xa2f9836e4e441529, 0xfc2757d1f534ddc0, 0xdb6295993c439041, 0xfe5163abdebbc561,
    0xb7246e3a424dd2e0, 0x06492eea09d1921c, 0xfe1deb1cb129a73e, 0xe88235f52ebb4484,
    0xe99c7026b45f7e41, 0x3991d639835339f4, 0x9c845f8bbdf9283b, 0x1ff897ffde05980f,
    0xef2f118b5a0a6d1f, 0x6d367ecf27cb09b7, 0x4f463f669e5fea2d, 0x7527bac7ebe5f17b,
    0x3d0739f78a5292ea, 0x6bfb5fb11f8d5d08, 0x56033046fc7b6bab, 0xf0cfbc209af4361d,
    0xa9e391615ee61b08, 0x6599855f14a06840, 0x8dffd8804d732731, 0x06061556ca73a8c9,
];

/// Words of the fixed-point number `x·2/π mod 4`, least significant first.
const WORDS: usize = 6;
/// Its bits after the point; two stand before it.
const FRACTION: usize = 64 * WORDS - 2;

/// `(n mod 4, r)` with `x = n·π/2 + r`, for finite `x = high + low`; `r` has two words as well.
pub fn reduce(high: f64, low: f64) -> (u64, (f64, f64)) {
    if high.abs() <= 0.785 {
        return (0, (high, low));
    }
    // Half a turn of a quadrant is added, so that cutting off the fraction rounds to nearest.
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

/// [`reduce`] for finite angles of one word from 2²⁰ on, of either sign, with a relative error of about 2⁻⁶⁴; NaN
/// where they are not finite, anything below 2²⁰. Every operation rounds alike on both sides of 0.
///
/// The angle is a whole number of 53 bits times a power of two, whose product with 2/π, modulo 4, is a sum of
/// four words ([`two_over_pi`]). The first product is exact; so is its remainder modulo 8, to which the
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

/// Added to a number up to 2⁵⁴ and taken off again it rounds it to a multiple of 8.
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

/// `2^(field − 1075)·2/π` modulo 4, for the exponent field of an angle from 2 on: a sum of words up to 2,
/// 2⁻⁵¹, 2⁻¹⁰¹ and 2⁻¹⁵⁴. They are multiples of 2⁻⁵⁰, 2⁻¹⁰⁰, 2⁻¹⁵³ and 2⁻¹⁹⁰. NaN for the field of infinity.
pub const fn two_over_pi(field: u64) -> [f64; 4] {
    if field == 2047 {
        return [f64::NAN; 4];
    }
    // The bit worth 2 comes first.
    let start = field as usize + 62 - 1075;
    let (a, b, c) = (window(start), window(start + 64), window(start + 128));
    // Each word is rounded to nearest: what is left has a sign.
    let first = a.wrapping_add(1 << 11) as i64 >> 12;
    let rest = (a << 52) as i64 >> 52;
    let second = (rest << 38) + (b >> 26) as i64 + (b >> 25 & 1) as i64;
    let rest = (b << 38) as i64 >> 38;
    let third = (rest << 27) + (c >> 37) as i64 + (c >> 36 & 1) as i64;
    let rest = (c << 27) as i64 >> 27;
    [
        first as f64 * two_to(-50),
        second as f64 * two_to(-100),
        third as f64 * two_to(-153),
        rest as f64 * two_to(-190),
    ]
}

/// [`two_over_pi`] of the fields from 1024 on: 32 kB, which only packs refer to.
pub static TWO_OVER_PI_MODULO_4: [[f64; 4]; 1024] = {
    let mut rows = [[0.0; 4]; 1024];
    let mut k = 0;
    while k < 1024 {
        rows[k] = two_over_pi(k as u64 + 1024);
        k += 1;
    }
    rows
};

/// `2^k` for −1022 ≤ k ≤ 1023, in constants.
const fn two_to(k: i64) -> f64 {
    f64::from_bits(((1023 + k) as u64) << 52)
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

/// 64 bits of 2/π from the bit `start − 64` after the point.
#[inline(always)]
const fn window(start: usize) -> u64 {
    let (word, bit) = (start / 64, start % 64);
    let next = if bit == 0 {
        0
    } else {
        TWO_OVER_PI[word + 1] >> (64 - bit)
    };
    TWO_OVER_PI[word] << bit | next
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
