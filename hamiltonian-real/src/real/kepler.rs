//! Kepler's equation in universal variables, for every conic and both signs of time.
//!
//! Input: the equation in units of the distance and of the time. Output: the universal anomaly, and
//! Stumpff's functions. Invariant: a converged lane does not change any more, so its bits do not
//! depend on the other lanes; a lane that does not converge is NaN.

use super::series::{COS, COS_TAIL, SIN, SIN_TAIL};
use super::{Mask, Real};

/// The largest number of steps of an iteration. Beyond [`PATIENCE`] every other step halves the
/// bracket.
const STEPS: u32 = 128;
const PATIENCE: u32 = 12;

/// The revolutions from which on an angle has no digits, 2⁵⁰.
const LONGEST: f64 = (1_u64 << 50) as f64;

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
    let (far_two, far_three) = T::out_of_line(
        #[inline(always)]
        move || stumpff_far(psi),
    );
    (
        T::select(is_small, two, far_two),
        T::select(is_small, three, far_three),
    )
}

/// The same outside of −1 < ψ < 1, elsewhere any number.
#[inline(always)]
fn stumpff_far<T: Real>(psi: T) -> (T, T) {
    let one = T::one();
    let half = T::constant(0.5, 0.0);
    // A lane whose value is not used computes the function of a harmless number.
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
    (far_two, far_three)
}

/// Σ (−ψ)ʲ·cⱼ for |ψ| ≤ 1, to the precision of this scalar: even and odd powers in parallel.
#[inline(always)]
fn alternating<T: Real, const N: usize, const M: usize>(
    psi: T,
    table: &[(f64, f64); N],
    tail: &[f64; M],
) -> T {
    let square = psi * psi;
    let mut sums = [T::zero(); 2];
    // 1/18! and 1/19! are a thousandth of a double's last place.
    let short = if T::epsilon() < f64::EPSILON { M } else { 1 };
    let mut at = N + short;
    while at > 0 {
        at -= 1;
        let (high, low) = if at < N {
            table[at]
        } else {
            (tail[at - N], 0.0)
        };
        sums[at % 2] = sums[at % 2].fma(square, T::constant(high, low));
    }
    (-psi).fma(sums[1], sums[0])
}

/// The part of the time of a motion that is left after its whole revolutions, in units of that time: 1 if there is
/// none, and of either sign, since the nearest whole number is taken off. NaN if no digit of the angle is known.
///
/// F grows by 2πb/c^{3/2} in each revolution: the solver and the increments of q and p would lose the digits of
/// a part of a revolution in a long time.
#[inline(always)]
pub(crate) fn remainder<T: Real>(b: T, c: T) -> T {
    let (zero, one) = (T::zero(), T::one());
    // 2π
    let tau = T::constant(core::f64::consts::TAU, 2.449_293_598_294_706_4e-16);
    let around = tau * b;
    let is_bound = zero.lt(b) & zero.lt(c);
    let returns = is_bound & (around * around).le(c * c * c);
    if !returns.any() {
        return one;
    }
    T::out_of_line(
        #[inline(always)]
        move || remainder_where(returns, around, c),
    )
}

/// The same where the motion returns, elsewhere 1.
#[inline(always)]
fn remainder_where<T: Real>(returns: T::Mask, around: T, c: T) -> T {
    let one = T::one();
    let c = T::select(returns, c, one);
    let turns = c * c.sqrt() / T::select(returns, around, one);
    let left = (turns - turns.round()) / turns;
    let digits = turns.lt(T::constant(LONGEST, 0.0));
    let left = T::select(digits, left, T::constant(f64::NAN, 0.0));
    T::select(returns, left, one)
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
/// F rises: F′ is the ratio of the distances, so that there is one solution, between 0 and, for c >
/// 0, the mean motion's c/b and 2/√c more. Laguerre's steps (B. A. Conway, *Celest. Mech.* 39, 199,
/// 1986, doi:10.1007/BF01230852), kept inside the bracket of the solution, and one of Newton's.
#[inline(always)]
pub(crate) fn anomaly<T: Real>(a: T, b: T, c: T) -> T {
    // Of a pack, whose code grows with its registers, a program has one copy.
    if T::LANES == 1 {
        return anomaly_here(a, b, c);
    }
    T::out_of_line(
        #[inline(always)]
        move || anomaly_here(a, b, c),
    )
}

/// The same, at its use.
#[inline(always)]
fn anomaly_here<T: Real>(a: T, b: T, c: T) -> T {
    let (zero, one) = (T::zero(), T::one());
    let number = |x: f64| T::constant(x, 0.0);
    let nan = number(f64::NAN);
    // Laguerre's steps converge cubically, and one of Newton's doubles the digits once more.
    let rounding = number(T::epsilon());
    let tolerance = number(if T::epsilon() < 1e-20 { 1e-9 } else { 2e-5 });
    let half = number(0.5);
    let bent = b - c;
    let is_near = (a.abs() + bent.abs()).lt(half) & c.abs().lt(one);
    // Near the start of the motion: its series in the time.
    let second = half * a * a - number(1.0 / 6.0) * bent;
    let third = a * (number(5.0 / 12.0) * bent + number(1.0 / 24.0) * c - number(0.625) * a * a);
    let mut y = one - half * a + (second + third);
    if !is_near.all() {
        let far = (one + a.abs().sqrt() + bent.abs().cbrt()).recip();
        y = T::select(is_near, y, far);
    }
    let (mut low, mut high) = (zero, number(f64::INFINITY));
    let is_bound = zero.lt(c) & zero.lt(b) & !is_near;
    if is_bound.any() {
        let mean = c / b;
        let off = number(2.0) / c.sqrt();
        high = T::select(is_bound, mean + off, high);
        low = T::select(is_bound & off.lt(mean), mean - off, low);
        // More than a radian away the mean motion is the better guess.
        let is_far = is_bound & one.lt(c * mean * mean);
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
        // The half of a bracket gives no information until the bracket is as small as a rounding
        // error.
        let near = T::select(steps, tolerance, rounding);
        solved = solved | change.le(near * next);
        k += 1;
    }
    let (f, slope, _) = equation(a, b, c, y);
    T::select(solved, y - f / slope, nan)
}
