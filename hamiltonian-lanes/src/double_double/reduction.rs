//! Angles modulo π/2, for every finite double-double.
//!
//! Input: an angle `x`. Output: the quadrant `n mod 4` and the rest `r`, |r| ≤ π/4, of
//! `x = n·π/2 + r`. Invariant: `r` has a relative error of about 2⁻¹⁰³ however large `x` is and
//! however near to a multiple of π/2.
//!
//! The method is that of M. H. Payne and R. N. Hanek (*ACM SIGNUM Newsl.* 18, 19, 1983,
//! doi:10.1145/1057600.1057602): each word of `x` is an integer times a power of two, and only
//! that window of the bits of 2/π is multiplied whose product neither is a multiple of 4 nor lies
//! below the wanted precision. Both words' products are exact integers, so their cancellation
//! costs nothing.

use super::DoubleDouble;
use super::arithmetic::power_of_two;
use super::constants::{FRAC_PI_2, TWO_OVER_PI};

/// Words of the fixed-point number `x·2/π mod 4`, least significant first.
const WORDS: usize = 6;
/// Its bits after the point; two stand before it.
const FRACTION: usize = 64 * WORDS - 2;

/// `(n mod 4, r)` with `x = n·π/2 + r`, for finite `x`.
pub(crate) fn reduce(x: DoubleDouble) -> (u64, DoubleDouble) {
    if x.hi.abs() <= 0.785 {
        return (0, x);
    }
    // Half a turn of a quadrant is added, so that cutting off the fraction rounds to nearest.
    let mut turns = [0; WORDS];
    turns[WORDS - 1] = 1 << 61;
    add_turns(&mut turns, x.hi);
    add_turns(&mut turns, x.lo);

    let top = turns[WORDS - 1];
    let quadrant = top >> 62;
    // Below the middle the rest is negative; bits 61 and down are rest + ½.
    let negative = top & (1 << 61) == 0;
    turns[WORDS - 1] = top & ((1 << 61) - 1);
    if negative {
        let half = [0, 0, 0, 0, 0, 1 << 61];
        turns = sum(half, turns.map(|word| !word), true);
    }
    let rest = to_double_double(&turns) * FRAC_PI_2;
    (quadrant, if negative { -rest } else { rest })
}

/// `turns += word·2/π`, modulo 4.
fn add_turns(turns: &mut [u64; WORDS], word: f64) {
    if word == 0.0 {
        return;
    }
    let bits = word.to_bits();
    let field = ((bits >> 52) & 0x7ff) as i32;
    let significand = (bits & ((1 << 52) - 1)) | if field > 0 { 1 << 52 } else { 0 };
    // |word| = significand·2^scale.
    let scale = field.max(1) - 1075;

    // Bits of 2/π worth 4 or more after scaling give multiples of 4: start after them.
    let start = (scale - 2).max(0) as usize;
    let mut product = [0u64; WORDS + 1];
    let mut carry = 0u128;
    for (i, out) in product.iter_mut().take(WORDS).enumerate() {
        let factor = window(start + 64 * (WORDS - 1 - i));
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

/// 64 bits of 2/π from the bit `start` after the point.
fn window(start: usize) -> u64 {
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
fn to_double_double(fraction: &[u64; WORDS]) -> DoubleDouble {
    let leading = fraction.iter().rposition(|&word| word != 0).unwrap_or(0);
    let mut value = DoubleDouble::from(0.0);
    for i in (leading.saturating_sub(2)..=leading).rev() {
        let unit = power_of_two(64 * i as i32 - FRACTION as i32);
        for half in [fraction[i] >> 32 << 32, fraction[i] & 0xffff_ffff] {
            value = value.add_f64(half as f64 * unit);
        }
    }
    value
}
