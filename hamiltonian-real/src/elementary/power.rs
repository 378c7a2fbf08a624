//! Powers, cube root, distance.
//!
//! Input: any doubles. Output: the function's value. Invariant: `x^y = exp(y·ln x)` with the
//! logarithm and the product of two words; the cube root and the distance correct a first value by
//! an exact remainder. Powers of bases that are not positive, normal and finite, and results near or beyond
//! the ends of the range, are computed out of line.

use super::coefficients::*;
use super::exponential::{exp_any_in_lanes, exp_parts, scale_normal};
use super::logarithm::ln_pair;
use super::pairs::{
    fast_two_sum, flip, sign_bit, square_root, times_two_to_52, two_product, two_square, unless,
};
use crate::real::{Mask, Real};
use crate::word::{Bits, Rare, Word};

const TWO_TO_52: f64 = (1u64 << 52) as f64;

/// Returns true if `x` is positive, normal and finite.
#[inline(always)]
fn is_plain<W: Word>(x: W) -> W::Mask {
    W::splat(f64::MIN_POSITIVE).le(x) & x.le(W::splat(f64::MAX))
}

/// `y·ln x` of two words, for a positive normal `x`.
#[inline(always)]
fn exponent<W: Word>(x: W, y: W, shift: W) -> (W, W) {
    let (high, low) = ln_pair(x, shift);
    let (product, cut) = two_product(y, high);
    (product, y.fma(low, cut))
}

/// The exponent below which a power is 1 to the last bit.
const TINY_EXPONENT: f64 = 1.0 / (1u128 << 70) as f64;

/// `x^y`.
#[inline(always)]
pub fn pow<W: Word>(x: W, y: W) -> W {
    // The power is 1 to the last bit for every `x`, whose logarithm is below 2¹⁰.
    let tiny = y.abs().lt(W::splat(TINY_EXPONENT));
    let (high, low) = exponent(x, unless(tiny, y), W::zero());
    let (power, one, rest) = exp_parts(high, low);
    let value = scale_normal(one + rest, power);
    // Splitting the largest exponents overflows.
    let plain = is_plain(x) & high.abs().le(W::splat(708.0)) & y.abs().le(W::splat(1e300));
    if plain.all() {
        return value;
    }
    W::rare::<Power, 2, 1>([x, y])[0]
}

struct Power;

impl Rare<2, 1> for Power {
    /// With the special cases of C17, annex F.10.4.4.
    #[inline(always)]
    fn of<W: Word>([x, y]: [W; 2]) -> [W; 1] {
        let (zero, one) = (W::zero(), W::one());
        let size = x.abs();
        let (nothing, infinite) = (size.equals(zero), W::splat(f64::INFINITY).le(size));
        let ends = nothing | infinite;
        let defined = x.equals(x) & y.equals(y);
        // A subnormal number is an integer, which the bits of 2⁵² and it make a number.
        let subnormal = size.lt(W::splat(f64::MIN_POSITIVE));
        let integer = W::from_bits(size.bits() | W::Bits::splat(TWO_TO_52.to_bits()));
        let integer = integer - W::splat(TWO_TO_52);
        let base = W::select(subnormal, integer * W::splat(f64::MIN_POSITIVE), size);
        let shift = W::select(subnormal, W::splat(-52.0), zero);
        let base = W::select(ends | !defined, one, base);

        // Beyond this every power is 0, 1 or infinite.
        let most = W::splat(1e25);
        let tiny = y.abs().lt(W::splat(TINY_EXPONENT));
        let exponent_size = Real::min(y.abs(), most);
        let bounded = flip(exponent_size, sign_bit(y));
        let (high, low) = exponent(base, unless(tiny, bounded), shift);
        let value = exp_any_in_lanes(high, low, 0.0);

        let (whole, odd) = parity(y);
        let falling = y.lt(zero);
        let grows = (nothing & falling) | (infinite & !falling);
        let end = W::select(grows, W::splat(f64::INFINITY), zero);
        let value = W::select(ends, end, value);
        let negative = W::odd(sign_bit(x).shr::<63>());
        let value = W::select(negative & odd, -value, value);
        let none = negative & !whole & !ends;
        let value = W::select(none, W::splat(f64::NAN), value);
        let value = W::select(defined, value, x + y);
        [W::select(y.equals(zero) | x.equals(one), one, value)]
    }
}

/// The masks of numbers, not NaN, that are integers or infinite, and that are odd integers.
#[inline(always)]
fn parity<W: Word>(y: W) -> (W::Mask, W::Mask) {
    let size = y.abs();
    let limit = W::splat(TWO_TO_52);
    let small = size.lt(limit);
    // The last bit is worth 1 up to 2⁵³, and 2 or more above.
    let shifted = W::select(small, size, W::zero()) + limit;
    let whole = !small | (shifted - limit).equals(size);
    let large = size.lt(limit + limit) & W::odd(size.bits()) & !small;
    (whole, (small & whole & W::odd(shifted.bits())) | large)
}

/// A third of the upper bits of `x`, with an offset that makes `x^(−1/3)` to within 3.5 %.
#[inline(always)]
fn guess_inverse_cube_root<W: Word>(x: W) -> W {
    let third = W::third(x.bits().shr::<32>());
    W::from_bits(W::Bits::splat(CUBE_ROOT_OFFSET).minus(third).shl::<32>())
}

/// The cube root of a positive normal number. With `e = 1 − x·y³`, x^(−1/3) is
/// y·(1 − e)^(−1/3) = y·(1 + e/3 + 2e²/9 + 14e³/81 + …), twice over; the second time around a
/// root `c` of 17 bits, whose cube is exact.
#[inline(always)]
fn cube_root<W: Word>(x: W) -> W {
    let (a1, a2) = (W::splat(1.0 / 3.0), W::splat(2.0 / 9.0));
    let (a3, a4) = (W::splat(14.0 / 81.0), W::splat(35.0 / 243.0));
    // This is computed early, in parallel with the rest.
    let inverse = W::one() / x;
    let y = guess_inverse_cube_root(x);
    let e = W::one() - (x * y) * (y * y);
    let (square, step) = (e * e, y * e);
    let y = (step * square).fma(e.fma(a4, a3), step.fma(e.fma(a2, a1), y));
    // Cut off to 17 bits: within 2⁻¹⁵·⁷ of the root.
    let c = (x * (y * y)).cut::<36>();
    // cbrt x = c·(1 − d)^(−1/3) with d = (x − c³)/x; the remainder is exact.
    let d = (x - c * c * c) * inverse;
    (c * d).fma((d * d).fma(a3, d.fma(a2, a1)), c)
}

/// For numbers between the inverse of this and this, every term of the cube root is normal: 2⁹⁶⁰,
/// the cube of 2³²⁰.
const CUBABLE: f64 = f64::from_bits((1023 + 960) << 52);
const CUBABLE_ROOT: f64 = f64::from_bits((1023 + 320) << 52);

/// Cube root.
#[inline(always)]
pub fn cbrt<W: Word>(x: W) -> W {
    let size = x.abs();
    let plain = W::splat(1.0 / CUBABLE).le(size) & size.le(W::splat(CUBABLE));
    if W::LANES == 1 && !plain.all() {
        return x.replace(W::Mask::splat(true), x, cbrt_of_rare);
    }
    if plain.all() {
        return flip(cube_root(size), sign_bit(x));
    }
    // The scales are cubes of powers of two.
    let (large, small) = (W::splat(CUBABLE).lt(size), size.lt(W::splat(1.0 / CUBABLE)));
    let (up, down) = (W::splat(CUBABLE), W::splat(1.0 / CUBABLE));
    let scale = W::select(large, down, W::select(small, up, W::one()));
    let (up, down) = (W::splat(CUBABLE_ROOT), W::splat(1.0 / CUBABLE_ROOT));
    let back = W::select(large, up, W::select(small, down, W::one()));
    let root = cube_root(size * scale) * back;
    let itself = size.equals(W::zero()) | !size.le(W::splat(f64::MAX));
    W::select(itself, x, flip(root, sign_bit(x)))
}

#[cold]
#[inline(never)]
fn cbrt_of_rare(x: f64) -> f64 {
    let size = x.abs();
    let root = if size == 0.0 || !size.is_finite() {
        return x;
    } else if size > 1.0 {
        cube_root(size / CUBABLE) * CUBABLE_ROOT
    } else if size < f64::MIN_POSITIVE {
        // 2⁵⁴ is the cube of 2¹⁸.
        cube_root(4.0 * times_two_to_52(size)) / (1u64 << 18) as f64
    } else {
        cube_root(size * CUBABLE) / CUBABLE_ROOT
    };
    flip(root, sign_bit(x))
}

/// Squares of numbers between the inverse of this and this neither overflow nor lose their rounding
/// errors.
const SQUARABLE: f64 = (1u128 << 127) as f64 * (1u128 << 127) as f64 * (1u128 << 127) as f64;

/// A power of two that makes every other number squarable.
const SCALE: f64 = 2.0 * SQUARABLE * SQUARABLE;

/// A number below this does not change the distance, beside any number that is squarable.
const NEGLIGIBLE: f64 = 1.0 / SQUARABLE / (1u128 << 69) as f64;

/// `√(large² + small²)` for 0 ≤ small ≤ large within `SQUARABLE`.
#[inline(always)]
fn distance<W: Word>(large: W, small: W) -> W {
    let (a, a_cut) = two_square(large);
    let small = unless(small.lt(W::splat(NEGLIGIBLE)), small);
    let (b, b_cut) = two_square(small);
    let (sum, cut) = fast_two_sum(a, b);
    let (root, rest) = square_root((sum, cut + (a_cut + b_cut)));
    root + rest
}

/// `√(x² + y²)`.
#[inline(always)]
pub fn hypot<W: Word>(x: W, y: W) -> W {
    let (x_size, y_size) = (x.abs(), y.abs());
    let x_larger = y_size.le(x_size);
    let large = W::select(x_larger, x_size, y_size);
    let small = W::select(x_larger, y_size, x_size);
    // A NaN as the smaller one is rare: the comparison that orders them is false.
    let plain =
        large.le(W::splat(SQUARABLE)) & W::splat(1.0 / SQUARABLE).le(large) & small.le(large);
    if W::LANES == 1 && !plain.all() {
        return x.replace2(W::Mask::splat(true), x, y, hypot_of_rare);
    }
    if plain.all() {
        return distance(large, small);
    }
    // Numbers of which a word of the square would be lost are scaled by a power of two; negligible
    // ones come first.
    let one = W::one();
    let (above, below) = (
        W::splat(SQUARABLE).lt(large),
        large.lt(W::splat(1.0 / SQUARABLE)),
    );
    let lost = W::splat(SQUARABLE * SQUARABLE * NEGLIGIBLE);
    let small = unless(above & small.lt(lost), small);
    let (up, down) = (W::splat(SCALE), W::splat(1.0 / SCALE));
    let scale = W::select(above, down, W::select(below, up, one));
    let back = W::select(above, up, W::select(below, down, one));
    let scaled = distance(large * scale, small * scale) * back;
    // Infinities and NaN.
    scaled.or_rare2(
        large.le(W::splat(f64::MAX)) & small.le(large),
        x,
        y,
        hypot_of_rare,
    )
}

#[cold]
#[inline(never)]
fn hypot_of_rare(x: f64, y: f64) -> f64 {
    let (x, y) = (x.abs(), y.abs());
    if x.is_infinite() || y.is_infinite() {
        return f64::INFINITY;
    }
    if x.is_nan() || y.is_nan() {
        return x + y;
    }
    let (large, small) = if x < y { (y, x) } else { (x, y) };
    if small == 0.0 {
        return large;
    }
    let scale = if large > 1.0 { 1.0 / SCALE } else { SCALE };
    distance(large * scale, small * scale) / scale
}
