//! Kepler's equation in universal variables, for every conic and both signs of time.
//!
//! Input: the equation in units of the distance and of the time. Output: the universal anomaly, and
//! Stumpff's functions. Invariant: a lane that has converged is not touched any more, so its bits
//! depend on nothing in the other lanes; what does not converge is NaN.

use crate::double_double::constants::{COS, COS_TAIL, SIN, SIN_TAIL};
use crate::real::{Mask, Real};

/// The most steps of an iteration. Past [`PATIENCE`] every other one halves the bracket.
const STEPS: u32 = 128;
const PATIENCE: u32 = 12;

/// c₂(ψ) = (1 − cos √ψ)/ψ and c₃(ψ) = (√ψ − sin √ψ)/√ψ³, entire functions of ψ.
///
/// K. Stumpff, *Himmelsmechanik* I, 1959, §41.
#[inline(always)]
pub(crate) fn stumpff<T: Real>(psi: T) -> (T, T) {
    let one = T::one();
    let is_small = (-one).lt(psi) & psi.lt(one);
    let (two, three) = (
        alternating(psi, &COS, &COS_TAIL),
        alternating(psi, &SIN, &SIN_TAIL),
    );
    if is_small.all() {
        return (two, three);
    }
    let half = T::constant(0.5, 0.0);
    // What is not wanted in a lane is the function of a number that does no harm.
    let turns = one.le(psi);
    let angle = T::select(turns, psi, one).sqrt();
    let (sin, cos) = (half * angle).sin_cos();
    let (square, product) = (sin * sin, sin * cos);
    let far = T::select(turns, psi, one);
    let (mut far_two, mut far_three) = (
        (square + square) / far,
        (angle - (product + product)) / (angle * far),
    );
    let grows = psi.le(-one);
    if grows.any() {
        let far = T::select(grows, -psi, one);
        let angle = far.sqrt();
        let (sinh, cosh) = ((half * angle).sinh(), (half * angle).cosh());
        let (square, product) = (sinh * sinh, sinh * cosh);
        far_two = T::select(grows, (square + square) / far, far_two);
        far_three = T::select(
            grows,
            (product + product - angle) / (angle * far),
            far_three,
        );
    }
    (
        T::select(is_small, two, far_two),
        T::select(is_small, three, far_three),
    )
}

/// Σ (−ψ)ʲ·cⱼ for |ψ| ≤ 1, as far as this scalar tells.
#[inline(always)]
fn alternating<T: Real>(psi: T, table: &[(f64, f64)], tail: &[f64]) -> T {
    let x = -psi;
    let mut sum = T::zero();
    let mut from = table.len();
    if T::epsilon() < f64::EPSILON {
        for c in tail.iter().rev() {
            sum = sum.fma(x, T::constant(*c, 0.0));
        }
    } else {
        // 1/18! and 1/19! are what a double is short of by a thousandth of its last place.
        sum = T::constant(tail[0], 0.0);
    }
    while from > 0 {
        from -= 1;
        let (high, low) = table[from];
        sum = sum.fma(x, T::constant(high, low));
    }
    sum
}

/// Kepler's equation F(y) = y·c₁(ψ) + a·y²·c₂(ψ) + b·y³·c₃(ψ) − 1 with ψ = c·y², and F′, F″.
#[inline(always)]
pub(crate) fn equation<T: Real>(a: T, b: T, c: T, y: T) -> (T, T, T) {
    let one = T::one();
    let square = y * y;
    let psi = c * square;
    let (two, three) = stumpff(psi);
    let (c0, c1) = (one - psi * two, one - psi * three);
    let (g1, g2, g3) = (y * c1, square * two, square * y * three);
    (
        g1 + a * g2 + (b * g3 - one),
        c0 + a * g1 + b * g2,
        a * c0 + (b - c) * g1,
    )
}

/// The solution y of [`equation`].
///
/// F rises: F′ is the ratio of the distances, so that there is one solution, between 0 and, for
/// c > 0, the mean motion's c/b and 2/√c more. Laguerre's steps (B. A. Conway, *Celest. Mech.* 39,
/// 199, 1986, doi:10.1007/BF01230852), kept inside what brackets the solution, and one of Newton's.
#[inline(always)]
pub(crate) fn anomaly<T: Real>(a: T, b: T, c: T) -> T {
    let (zero, one) = (T::zero(), T::one());
    let number = |x: f64| T::constant(x, 0.0);
    let nan = number(f64::NAN);
    // Cubic convergence, and a step of Newton's after it.
    let rounding = number(T::epsilon());
    let tolerance = rounding.cbrt();
    // Near the start of the motion: its series.
    let (half, sixth) = (number(0.5), number(1.0 / 6.0));
    let bent = b - c;
    let near = one - half * a + (half * a * a - sixth * bent);
    let far = (one + a.abs().sqrt() + bent.abs().cbrt()).recip();
    let is_near = (a.abs() + bent.abs()).lt(half);
    let mut y = T::select(is_near, near, far);
    let (mut low, mut high) = (zero, number(f64::INFINITY));
    let is_bound = zero.lt(c) & zero.lt(b);
    if is_bound.any() {
        let mean = c / b;
        let off = number(2.0) / c.sqrt();
        high = T::select(is_bound, mean + off, high);
        low = T::select(is_bound & off.lt(mean), mean - off, low);
        // More than a radian away the mean motion is the better guess.
        let is_far = is_bound & one.lt(c * mean * mean) & !is_near;
        y = T::select(is_far, mean, y);
    }
    let mut solved = !(a.finite() & b.finite() & c.finite());
    y = T::select(solved, nan, y);
    let mut k = 0;
    while k < STEPS && !solved.all() {
        let (f, slope, bend) = equation(a, b, c, y);
        let is_below = f.lt(zero);
        low = T::select(is_below, y, low);
        high = T::select(is_below, high, y);
        // n = 5
        let (n, less) = (number(5.0), number(4.0));
        let root = (less * (less * slope * slope - n * f * bend)).abs().sqrt();
        let change = n * f / (slope + root);
        let mut next = y - change;
        let is_between = high.le(number(f64::MAX));
        let is_slow = T::Mask::splat(k > PATIENCE && k % 2 == 0);
        let steps = low.le(next) & next.le(high) & !(is_slow & is_between);
        let middle = T::select(is_between, half * (low + high), y + y);
        next = T::select(steps, next, middle);
        let change = (next - y).abs();
        y = T::select(solved, y, next);
        // Half of a bracket says nothing before the bracket is a rounding.
        let near = T::select(steps, tolerance, rounding);
        solved = solved | change.le(near * next);
        k += 1;
    }
    let (f, slope, _) = equation(a, b, c, y);
    T::select(solved, y - f / slope, nan)
}
