//! Inverse trigonometric functions.
//!
//! Input: any doubles. Output: the function's value. Invariant: an angle is a number of eighths of
//! a turn, whose head times a small integer is exact, and the arc tangent of a quotient of at most
//! √2 − 1 that keeps its second word; arc sine and arc cosine beyond ½ go through the half angle,
//! with the second word of its root.

use super::coefficients::*;
use super::pairs::{
    fast_two_sum, flip, is_tiny, polynomial, quotient, sign_bit, square_root, unless,
};
use crate::real::{Mask, Real};
use crate::word::{Bits, Rare, Word};

/// The angle of the point (`x`, `y`) in [0, π], for 0 ≤ `x`, `y` where one may be 0, mirrored
/// where `mirror` is set.
#[inline(always)]
fn angle<W: Word>(y: W, x: W, mirror: W::Mask) -> W {
    let steep = x.lt(y);
    let small = W::select(steep, x, y);
    let large = W::select(steep, y, x);
    // tan(π/4 + t) = (1 + tan t)/(1 − tan t): beyond π/8 the angle is counted from π/4.
    let high = (large * W::splat(ROOT_2_LESS_1)).lt(small);
    let (difference, difference_cut) = fast_two_sum(-large, small);
    let (sum, sum_cut) = fast_two_sum(large, small);
    let zero = W::zero();
    let above = (
        W::select(high, difference, small),
        W::select(high, difference_cut, zero),
    );
    let below = (W::select(high, sum, large), W::select(high, sum_cut, zero));
    let (t, t_cut) = quotient(above, below);
    let long = unless(is_tiny(t.abs()), t);
    let z = long * long;
    let rest = (long * z).fma(polynomial(z, &ARC_TANGENT), t_cut);
    // Eighths of a turn; where they are counted down, the arc is subtracted.
    let eighths = W::select(high, W::one(), zero);
    let eighths = W::select(steep, W::splat(2.0) - eighths, eighths);
    let eighths = W::select(mirror, W::splat(4.0) - eighths, eighths);
    let signs = sign_bit(W::select(steep, -W::one(), W::one()))
        ^ sign_bit(W::select(mirror, -W::one(), W::one()));
    let (start, cut) = fast_two_sum(eighths * W::splat(QUARTER_PI_HEAD), flip(t, signs));
    start + (eighths.fma(W::splat(QUARTER_PI_REST), cut) + flip(rest, signs))
}

/// Arc tangent.
#[inline(always)]
pub fn atan<W: Word>(x: W) -> W {
    let size = x.abs();
    let tiny = is_tiny(size);
    if W::LANES == 1 && tiny.all() {
        return x;
    }
    // From there on the value is π/2 to the last bit.
    let end = W::splat(1e20);
    let size = unless(tiny, W::select(end.lt(size), end, size));
    let value = angle(size, W::one(), W::Mask::splat(false));
    W::select(tiny, x, flip(value, sign_bit(x)))
}

/// The larger coordinate must lie between the inverse of this and this, the smaller above the
/// inverse or be 0: then no error term underflows.
const PLAIN: f64 = (1u128 << 127) as f64 * (1u128 << 127) as f64 * (1u128 << 127) as f64;

/// Where the coordinates are as [`PLAIN`] says.
#[inline(always)]
fn is_plain<W: Word>(height: W, width: W) -> W::Mask {
    let small = Real::min(height, width);
    let large = Real::max(height, width);
    let least = W::splat(1.0 / PLAIN);
    // Farther apart the quotient may be subnormal, which two words cannot round once. The product may be infinite.
    let apart = !large.le(small * W::splat(PLAIN)) & !small.equals(W::zero());
    large.le(W::splat(PLAIN)) & least.le(large) & !apart
}

/// The angle of the point (`x`, `y`).
#[inline(always)]
pub fn atan2<W: Word>(y: W, x: W) -> W {
    let (height, width) = (y.abs(), x.abs());
    if !is_plain(height, width).all() {
        return W::rare::<AngleOfPoint, 2, 1>([y, x])[0];
    }
    flip(angle(height, width, x.lt(W::zero())), sign_bit(y))
}

struct AngleOfPoint;

impl Rare<2, 1> for AngleOfPoint {
    #[inline(always)]
    fn of<W: Word>([y, x]: [W; 2]) -> [W; 1] {
        let (zero, one) = (W::zero(), W::one());
        let (height, width) = (y.abs(), x.abs());
        let left = W::odd(sign_bit(x).shr::<63>());
        // Two zeros are as 0 and 1, two infinities as 1 and 1.
        let infinite = W::splat(f64::INFINITY).le(Real::min(height, width));
        let nothing = Real::max(height, width).equals(zero);
        let height = W::select(infinite, one, height);
        let width = W::select(infinite | nothing, one, width);

        let plain = is_plain(height, width);
        let (small, large) = (Real::min(height, width), Real::max(height, width));
        // 2⁶⁰ and more apart the angle is the quotient, or a multiple of π/2 to the last bit. By products: a
        // quotient might be subnormal.
        let far = small * W::splat((1u64 << 60) as f64);
        let apart = Real::min(far, W::splat(f64::MAX)).lt(large) & !plain;
        let steep = width.lt(height);
        let scale = W::select(
            one.lt(large),
            W::splat(1.0 / PLAIN),
            W::splat(2.0 * PLAIN * PLAIN),
        );
        let scale = W::select(plain, one, scale);
        let (up, along) = (W::select(steep, one, zero), W::select(steep, zero, one));
        let mut value = angle(
            W::select(apart, up, height * scale),
            W::select(apart, along, width * scale),
            left,
        );
        let itself = apart & !steep & !left;
        if itself.any() {
            value = W::select(itself, height / width, value);
        }
        let defined = x.equals(x) & y.equals(y);
        [W::select(defined, flip(value, sign_bit(y)), x + y)]
    }
}

/// `(beyond, s, rest)` of 0 ≤ `x` ≤ 1: asin x = s + rest up to ½; beyond it `s + rest` is the arc
/// sine of √((1 − x)/2).
#[inline(always)]
fn arc_sine<W: Word>(x: W) -> (W::Mask, W, W) {
    let half = W::splat(0.5);
    let beyond = half.lt(x);
    let halved = half * (W::one() - x);
    let (root, cut) = square_root((halved, W::zero()));
    let long = unless(is_tiny(x), x);
    let z = W::select(beyond, halved, long * long);
    let s = W::select(beyond, root, x);
    let cut = W::select(beyond, cut, W::zero());
    (beyond, s, (s * z).fma(polynomial(z, &ARC_SINE), cut))
}

/// Arc sine; beyond ½, π/2 less twice that of the half angle.
#[inline(always)]
pub fn asin<W: Word>(x: W) -> W {
    let size = x.abs();
    if W::LANES == 1 && is_tiny(size).all() {
        return x;
    }
    let (beyond, s, rest) = arc_sine(size);
    let (high, cut) = fast_two_sum(W::splat(HALF_PI_HIGH), -(s + s));
    let far = high + (cut + (W::splat(HALF_PI_LOW) - (rest + rest)));
    flip(W::select(beyond, far, s + rest), sign_bit(x))
}

/// Arc cosine: π/2 − asin x up to ½; beyond it twice the arc sine of the half angle, or π less it.
#[inline(always)]
pub fn acos<W: Word>(x: W) -> W {
    let sign = sign_bit(x);
    let (beyond, s, rest) = arc_sine(x.abs());
    let zero = W::zero();
    let negative = x.lt(zero);
    // value = base − (s + rest) with the sign of x, the arc doubled beyond ½.
    let half_pi = (W::splat(HALF_PI_HIGH), W::splat(HALF_PI_LOW));
    let far = (
        W::select(negative, half_pi.0 + half_pi.0, zero),
        W::select(negative, half_pi.1 + half_pi.1, zero),
    );
    let base = (
        W::select(beyond, far.0, half_pi.0),
        W::select(beyond, far.1, half_pi.1),
    );
    let s = W::select(beyond, -(s + s), s);
    let rest = W::select(beyond, -(rest + rest), rest);
    let (high, cut) = fast_two_sum(base.0, -flip(s, sign));
    high + (cut + (base.1 - flip(rest, sign)))
}
