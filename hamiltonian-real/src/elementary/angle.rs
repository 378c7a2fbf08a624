//! Sine, cosine, tangent.
//!
//! Input: any double. Output: the function's value. Invariant: angles up to 2²⁰ are reduced
//! modulo π/2 in line, with the head of π/2 by parts whose products are exact, so that what is
//! left has a second word however near to a multiple of π/2 the angle lies. A pack with a larger one
//! is computed out of line, in lanes too, with [`reduction`] (Payne and Hanek). The usual value of a
//! pack is computed before that branch, so that a second sine of the same angle costs the branch alone.
//! The sign bit is taken off first and put back last, so that odd functions are odd to the bit. Tiny
//! angles are computed as 0, and stand where they are their own sine. Sine and cosine of fused lanes
//! need neither: every operation rounds alike on both sides of 0, and squares of tiny angles become 0.

use super::coefficients::*;
use super::pairs::{
    ROUNDER, fast_two_sum, flip, is_tiny, polynomial, quotient, sign_bit, two_square, unless,
};
use super::reduction;
use crate::real::Mask;
use crate::word::{Bits, Rare, Word};

/// Added to a square and taken off again; the squares that are lost in it change no sum.
const LOST: f64 = 1.0 / (1u128 << 100) as f64 / (1u128 << 100) as f64;

/// The largest angle that is reduced in line.
const LARGE: f64 = (1u64 << 20) as f64;

/// `(n, r, tail)` with `angle = n·π/2 + r + tail`, |r| ≤ π/4, for 0 ≤ angle ≤ [`LARGE`]; `n`
/// modulo 4 in the lowest bits.
#[inline(always)]
fn reduce<W: Word>(angle: W) -> (W::Bits, W, W) {
    let shifted = angle.fma(W::splat(TWO_OVER_PI), W::splat(ROUNDER));
    let (r, tail) = rest(angle, shifted - W::splat(ROUNDER));
    (shifted.bits(), r, tail)
}

/// [`reduce`] of a single angle; `None` beyond [`LARGE`]. Up to 3π/4 without the chain of operations that finds
/// `n`, the longer half of a single sine.
#[inline(always)]
fn reduce_one<W: Word>(angle: W) -> Option<(W::Bits, W, W)> {
    if angle.le(W::splat(0.78)).all() {
        return Some((W::Bits::splat(0), angle, W::zero()));
    }
    if (W::splat(0.79).le(angle) & angle.le(W::splat(2.35))).all() {
        let (r, tail) = rest(angle, W::one());
        return Some((W::Bits::splat(1), r, tail));
    }
    angle.le(W::splat(LARGE)).all().then(|| reduce(angle))
}

/// True if a single angle is tiny. [`reduce_one`] begins with the same comparison, so larger angles cost one less.
#[inline(always)]
fn one_is_tiny<W: Word>(angle: W) -> bool {
    angle.le(W::splat(0.78)).all() && is_tiny(angle).all()
}

/// [`reduce`] of angles of any size.
#[inline(always)]
fn reduce_any<W: Word>(angle: W) -> (W::Bits, W, W) {
    let large = reduction::reduce_large(angle);
    if W::LANES == 1 {
        // Smaller ones are not met here.
        return large;
    }
    let usual = angle.le(W::splat(LARGE));
    if usual.any() {
        return chosen(usual, reduce(angle), large);
    }
    large
}

/// The one reduced angle where the mask is set, the other elsewhere.
#[inline(always)]
fn chosen<W: Word>(mask: W::Mask, one: (W::Bits, W, W), other: (W::Bits, W, W)) -> (W::Bits, W, W) {
    (
        W::select(mask, W::from_bits(one.0), W::from_bits(other.0)).bits(),
        W::select(mask, one.1, other.1),
        W::select(mask, one.2, other.2),
    )
}

/// `(r, tail)` with `angle = n·π/2 + r + tail`.
#[inline(always)]
fn rest<W: Word>(angle: W, n: W) -> (W, W) {
    if W::FUSED {
        // Exact, since both terms are multiples of 2⁻⁵³ and the difference is below 1.
        let first = n.fma(W::splat(-HALF_PI_HIGH), angle);
        // The product is exact, so that the two words of the sum are.
        let r = n.fma(W::splat(-HALF_PI_LOW_HEAD), first);
        let cut = n.fma(W::splat(-HALF_PI_LOW_HEAD), first - r);
        (r, n.fma(W::splat(-HALF_PI_TAIL), cut))
    } else {
        // Three exact products; each sum keeps what it rounds off.
        let first = angle - n * W::splat(HALF_PI_1);
        let (low, cut) = fast_two_sum(n * W::splat(HALF_PI_2), n * W::splat(HALF_PI_3));
        let (r, rest) = fast_two_sum(first, -low);
        (r, (rest - cut) - n * W::splat(HALF_PI_4))
    }
}

/// `1 − z/2 = w + cut`.
#[inline(always)]
fn cosine_head<W: Word>(z: W) -> (W, W) {
    // Half of z is exact, so that each of these rounds once whether the type fuses or not.
    let w = z.fma(W::splat(-0.5), W::one());
    (w, z.fma(W::splat(-0.5), W::one() - w))
}

/// `((r, s), (w, c))`: sine and cosine of `r + tail` are `r + s` and `w + c`, for |r| ≤ π/4.
#[inline(always)]
fn parts<W: Word>(r: W, tail: W) -> ((W, W), (W, W)) {
    let z = r * r;
    let (w, cut) = cosine_head(z);
    let sine = (r * z).fma(polynomial(z, &SINE), tail * w);
    let cosine = (z * z).fma(polynomial(z, &COSINE), (-r).fma(tail, cut));
    ((r, sine), (w, cosine))
}

/// Sine and cosine in quadrant `n`, of an angle with the sign bit `sign`.
#[inline(always)]
fn turn<W: Word>(n: W::Bits, r: W, tail: W, sign: W::Bits) -> (W, W) {
    let ((r, s), (w, c)) = parts(r, tail);
    let (sine, cosine) = (r + s, w + c);
    let swapped = W::odd(n);
    let two = W::Bits::splat(2);
    let sine_sign = (n & two).shl::<62>() ^ sign;
    let cosine_sign = (n.plus(W::Bits::splat(1)) & two).shl::<62>();
    (
        flip(W::select(swapped, cosine, sine), sine_sign),
        flip(W::select(swapped, sine, cosine), cosine_sign),
    )
}

/// Tangent in quadrant `n`.
#[inline(always)]
fn slope<W: Word>(n: W::Bits, r: W, tail: W, sign: W::Bits) -> W {
    let ((r, s), (w, c)) = parts(r, tail);
    // The rounding of r² counts in a quotient.
    let c = W::splat(-0.5).fma(two_square(r).1, c);
    let (sine, cosine) = (fast_two_sum(r, s), fast_two_sum(w, c));
    let swapped = W::odd(n);
    let above = (
        W::select(swapped, cosine.0, sine.0),
        W::select(swapped, cosine.1, sine.1),
    );
    let below = (
        W::select(swapped, sine.0, cosine.0),
        W::select(swapped, sine.1, cosine.1),
    );
    let (high, low) = quotient(above, below);
    flip(high + low, n.shl::<63>() ^ sign)
}

/// [`turn`]'s sine, bit by bit, where the type does not fuse. In lanes, where sine and cosine do the same
/// operations, their operands are told apart before and the operations done once. A cosine is the sine a quadrant
/// on.
#[inline(always)]
fn sine_in<W: Word>(n: W::Bits, r: W, tail: W, sign: W::Bits) -> W {
    let swapped = W::odd(n);
    let z = r * r;
    if W::LANES == 1 {
        let sign = (n & W::Bits::splat(2)).shl::<62>() ^ sign;
        // One of the two series, by a branch; −w is had without a constant in a register.
        let minus_w = z.fma(W::splat(0.5), W::splat(-1.0));
        let y = if swapped.all() {
            let cut = z.fma(W::splat(-0.5), W::one() + minus_w);
            (z * z).fma(polynomial(z, &COSINE), (-r).fma(tail, cut)) - minus_w
        } else {
            r + (r * z).fma(polynomial(z, &SINE), -(tail * minus_w))
        };
        return flip(y, sign);
    }
    let (w, cut) = cosine_head(z);
    let rest = W::select(swapped, (-r).fma(tail, cut), tail * w);
    let factor = W::select(swapped, z, r) * z;
    // As in `polynomial`.
    let (square, first, second, third) = (
        z * z,
        coefficient::<W, 1>(swapped).fma(z, coefficient::<W, 0>(swapped)),
        coefficient::<W, 3>(swapped).fma(z, coefficient::<W, 2>(swapped)),
        coefficient::<W, 5>(swapped).fma(z, coefficient::<W, 4>(swapped)),
    );
    let series = first + third.fma(square * square, second * square);
    let y = W::select(swapped, w, r) + factor.fma(series, rest);
    flip(y, (n & W::Bits::splat(2)).shl::<62>() ^ sign)
}

/// Number `K` of [`COSINE`] where `swapped` is set, of [`SINE`] elsewhere.
#[inline(always)]
fn coefficient<W: Word, const K: usize>(swapped: W::Mask) -> W {
    W::select(swapped, W::splat(COSINE[K]), W::splat(SINE[K]))
}

/// Less number `K` of [`SINE`] where `is_sine` is set, of [`COSINE`] elsewhere.
#[inline(always)]
fn less_coefficient<W: Word, const K: usize>(is_sine: W::Mask) -> W {
    W::select(is_sine, W::splat(-SINE[K]), W::splat(-COSINE[K]))
}

/// The polynomial with the given coefficients by Horner's scheme: the fewest operations.
#[inline(always)]
fn horner<W: Word>(z: W, coefficients: &[f64; 6]) -> W {
    let [a, b, c, d, e, f] = *coefficients;
    let sum = W::splat(f).fma(z, W::splat(e)).fma(z, W::splat(d));
    let sum = sum.fma(z, W::splat(c)).fma(z, W::splat(b));
    sum.fma(z, W::splat(a))
}

/// An angle where the type fuses, modulo π/2.
#[derive(Clone, Copy)]
struct Turned<W: Word> {
    /// The quadrant and 1, modulo 4 in the lowest bits.
    bits: W::Bits,
    /// `r + tail` is what is left of the angle.
    r: W,
    tail: W,
}

impl<W: Word> Turned<W> {
    /// Of the angle up to [`LARGE`], `quadrants` further on. The angle keeps its sign: every operation
    /// rounds alike on both sides of 0.
    #[inline(always)]
    fn of(angle: W, quadrants: f64) -> Self {
        let rounder = W::splat(ROUNDER + quadrants + 1.0);
        let shifted = angle.fma(W::splat(TWO_OVER_PI), rounder);
        let (r, tail) = rest(angle, shifted - rounder);
        Turned {
            bits: shifted.bits(),
            r,
            tail,
        }
    }

    /// [`Turned::of`] angles of any size.
    #[inline(always)]
    fn of_any(angle: W, quadrants: f64) -> Self {
        let (n, r, tail) = reduction::reduce_large(angle);
        let bits = n.plus(W::Bits::splat(quadrants as u64 + 1));
        let usual = angle.abs().le(W::splat(LARGE));
        if !usual.any() {
            return Turned { bits, r, tail };
        }
        let other = Turned::of(angle, quadrants);
        let (bits, r, tail) = chosen(usual, (other.bits, other.r, other.tail), (bits, r, tail));
        Turned { bits, r, tail }
    }

    /// `(z, minus, cut)`: z = r², and z/2 − 1 = minus + cut.
    #[inline(always)]
    fn square(&self) -> (W, W, W) {
        // Squares below 2⁻²⁵⁴ become 0, so that no product is subnormal.
        let lost = W::splat(LOST);
        let z = self.r.fma(self.r, lost) - lost;
        let half = W::splat(0.5);
        let minus = z.fma(half, -W::one());
        (z, minus, z.fma(half, -W::one() - minus))
    }

    /// The sine. With −cos r = −1 + r²/2 − …, sine and −cosine are the difference and the sum of two
    /// words, and their terms have the same signs.
    #[inline(always)]
    fn sine(self) -> W {
        let Turned { bits, r, tail } = self;
        let (z, minus, cut) = self.square();
        let is_sine = W::odd(bits);
        let low = W::select(is_sine, minus, r).fma(tail, W::select(is_sine, W::zero(), cut));
        let factor = W::select(is_sine, r, z) * z;
        let mut series = less_coefficient::<W, 5>(is_sine);
        series = series.fma(z, less_coefficient::<W, 4>(is_sine));
        series = series.fma(z, less_coefficient::<W, 3>(is_sine));
        series = series.fma(z, less_coefficient::<W, 2>(is_sine));
        series = series.fma(z, less_coefficient::<W, 1>(is_sine));
        series = series.fma(z, less_coefficient::<W, 0>(is_sine));
        let rest = factor.fma(series, low);
        let y = W::select(is_sine, r - rest, minus + rest);
        flip(y, (bits & W::Bits::splat(2)).shl::<62>())
    }

    /// Sine and cosine, the bits of [`Turned::sine`].
    #[inline(always)]
    fn sine_and_cosine(self) -> (W, W) {
        let Turned { bits, r, tail } = self;
        let (z, minus, cut) = self.square();
        let is_sine = W::odd(bits);
        let sine = r - (-(r * z)).fma(horner(z, &SINE), minus.fma(tail, W::zero()));
        let cosine = minus + (-(z * z)).fma(horner(z, &COSINE), r.fma(tail, cut));
        let two = W::Bits::splat(2);
        let next = bits.plus(W::Bits::splat(1));
        (
            flip(W::select(is_sine, sine, cosine), (bits & two).shl::<62>()),
            flip(W::select(is_sine, cosine, sine), (next & two).shl::<62>()),
        )
    }
}

/// True if an angle of a pack is beyond [`LARGE`], or no number.
#[inline(always)]
fn is_any_large<W: Word>(x: W) -> bool {
    !x.abs().le(W::splat(LARGE)).all()
}

/// Sine.
#[inline(always)]
pub fn sin<W: Word>(x: W) -> W {
    if W::LANES == 1 && !W::FUSED {
        let angle = x.abs();
        if one_is_tiny(angle) {
            return x;
        }
        if let Some((n, r, tail)) = reduce_one(angle) {
            return sine_in(n, r, tail, sign_bit(x));
        }
        return W::rare::<Sine, 1, 1>([x])[0];
    }
    let usual = if W::FUSED {
        Turned::of(x, 0.0).sine()
    } else {
        let angle = x.abs();
        let tiny = is_tiny(angle);
        let (n, r, tail) = reduce(unless(tiny, angle));
        W::select(tiny, x, sine_in(n, r, tail, sign_bit(x)))
    };
    if is_any_large(x) {
        return W::rare::<Sine, 1, 1>([x])[0];
    }
    usual
}

struct Sine;

impl Rare<1, 1> for Sine {
    #[inline(always)]
    fn of<W: Word>([x]: [W; 1]) -> [W; 1] {
        if W::FUSED {
            return [Turned::of_any(x, 0.0).sine()];
        }
        let angle = x.abs();
        let tiny = is_tiny(angle);
        let (n, r, tail) = reduce_any(unless(tiny, angle));
        [W::select(tiny, x, sine_in(n, r, tail, sign_bit(x)))]
    }
}

/// Cosine.
#[inline(always)]
pub fn cos<W: Word>(x: W) -> W {
    if W::LANES == 1 && !W::FUSED {
        let angle = x.abs();
        if one_is_tiny(angle) {
            return W::one();
        }
        if let Some((n, r, tail)) = reduce_one(angle) {
            return sine_in(n.plus(W::Bits::splat(1)), r, tail, W::Bits::splat(0));
        }
        return W::rare::<Cosine, 1, 1>([x])[0];
    }
    let usual = if W::FUSED {
        Turned::of(x, 1.0).sine()
    } else {
        let angle = x.abs();
        let (n, r, tail) = reduce(unless(is_tiny(angle), angle));
        sine_in(n.plus(W::Bits::splat(1)), r, tail, W::Bits::splat(0))
    };
    if is_any_large(x) {
        return W::rare::<Cosine, 1, 1>([x])[0];
    }
    usual
}

struct Cosine;

impl Rare<1, 1> for Cosine {
    #[inline(always)]
    fn of<W: Word>([x]: [W; 1]) -> [W; 1] {
        if W::FUSED {
            return [Turned::of_any(x, 1.0).sine()];
        }
        let angle = x.abs();
        let (n, r, tail) = reduce_any(unless(is_tiny(angle), angle));
        let next = n.plus(W::Bits::splat(1));
        [sine_in(next, r, tail, W::Bits::splat(0))]
    }
}

/// Sine and cosine.
#[inline(always)]
pub fn sin_cos<W: Word>(x: W) -> (W, W) {
    let angle = x.abs();
    if W::LANES == 1 && !W::FUSED {
        if one_is_tiny(angle) {
            return (x, W::one());
        }
        let (n, r, tail) = match reduce_one(angle) {
            Some(reduced) => reduced,
            None => {
                let [n, r, tail] = W::rare::<ReducedAngle, 1, 3>([angle]);
                (n.bits(), r, tail)
            }
        };
        return turn(n, r, tail, sign_bit(x));
    }
    let usual = if W::FUSED {
        Turned::of(x, 0.0).sine_and_cosine()
    } else {
        let tiny = is_tiny(angle);
        let (n, r, tail) = reduce(unless(tiny, angle));
        let (sine, cosine) = turn(n, r, tail, sign_bit(x));
        (W::select(tiny, x, sine), cosine)
    };
    if is_any_large(x) {
        let [sine, cosine] = W::rare::<SineAndCosine, 1, 2>([x]);
        return (sine, cosine);
    }
    usual
}

struct SineAndCosine;

impl Rare<1, 2> for SineAndCosine {
    #[inline(always)]
    fn of<W: Word>([x]: [W; 1]) -> [W; 2] {
        if W::FUSED {
            let (sine, cosine) = Turned::of_any(x, 0.0).sine_and_cosine();
            return [sine, cosine];
        }
        let angle = x.abs();
        let tiny = is_tiny(angle);
        let (n, r, tail) = reduce_any(unless(tiny, angle));
        let (sine, cosine) = turn(n, r, tail, sign_bit(x));
        [W::select(tiny, x, sine), cosine]
    }
}

/// A large angle as [`reduce`] has it, the quadrant as the bits of a number.
struct ReducedAngle;

impl Rare<1, 3> for ReducedAngle {
    #[inline(always)]
    fn of<W: Word>([angle]: [W; 1]) -> [W; 3] {
        let (n, r, tail) = reduction::reduce_large(angle);
        [W::from_bits(n), r, tail]
    }
}

/// Tangent.
#[inline(always)]
pub fn tan<W: Word>(x: W) -> W {
    let angle = x.abs();
    if W::LANES == 1 {
        if one_is_tiny(angle) {
            return x;
        }
        if let Some((n, r, tail)) = reduce_one(angle) {
            return slope(n, r, tail, sign_bit(x));
        }
    }
    if W::LANES == 1 || is_any_large(x) {
        return W::rare::<Tangent, 1, 1>([x])[0];
    }
    let tiny = is_tiny(angle);
    let (n, r, tail) = reduce(unless(tiny, angle));
    W::select(tiny, x, slope(n, r, tail, sign_bit(x)))
}

struct Tangent;

impl Rare<1, 1> for Tangent {
    #[inline(always)]
    fn of<W: Word>([x]: [W; 1]) -> [W; 1] {
        let angle = x.abs();
        let tiny = is_tiny(angle);
        let (n, r, tail) = reduce_any(unless(tiny, angle));
        [W::select(tiny, x, slope(n, r, tail, sign_bit(x)))]
    }
}
