//! The pilot: a few steps from the start, which choose the size of steps and whether it varies.
//!
//! Input: a start. Output: the numbers with which a run begins. Invariant: the pilot depends on the start alone, and
//! makes at most 32 steps.

use super::density::APART;
use super::{AIM, DENSEST, Derivatives, Following, Follows, NUMBERS, WorkOf, fixed, larger, root};
use crate::schemes::adaptive::Estimates;
use crate::schemes::paced::{Pace, SOON};
use crate::schemes::scheme::CarriedBy;
use crate::systems::flow::Scratch;
use crate::systems::state::{Carried, Point};
use crate::systems::system::{System, VectorOf};
use crate::systems::vector::Vector;
use hamiltonian_lanes::{Mask, Real};

/// The most steps that look for the first size.
const TRIALS: u32 = 6;
/// The least and the most steps that follow: they end where sizes are no longer growing.
const FOLLOWED: [u32; 2] = [10, 26];
/// The largest first step, and the largest constant one, in units of 1/Q; without a Q, in units of the larger of |q|/|q̇|
/// and |p|/|ṗ|. Longer ones do not show how Q varies along the
/// orbit, and their equations take many iterations.
const LARGEST: [f64; 2] = [1.0, 1.5];
/// The largest factor between a size and the one with the error aimed at; between two trials of a first size.
const FARTHEST: f64 = 4.0;
/// See [`FARTHEST`].
const LEAP: f64 = 100.0;
/// Constant steps may be so many times as many as varying ones, which take three to four times as long each and more
/// iterations.
const WORTH: f64 = 5.0;

#[cfg_attr(not(unoptimised), inline(always))]
fn number<T: Real>(x: f64) -> T {
    T::constant(x, 0.0)
}

/// The factor of a size by which its error becomes the one aimed at, up to `most`.
fn factor<T: Real>(error: T, most: f64) -> T {
    let [least, most] = [number::<T>(0.1), number::<T>(most)];
    let factor = root(number::<T>(AIM) / error);
    // An error of 0, or one too small to be divided by, is the first case.
    let factor = T::select(factor.lt(most), factor, most);
    let factor = T::select(factor.lt(least), least, factor);
    T::select(error.finite(), fixed(factor), number(0.25))
}

/// The factor of the size after a step with this error was refused. A step whose equations were not solved may be a little
/// too long for them, or far too long.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn shrink<T: Real>(error: T, attempts: u32) -> T {
    let unknown = if attempts == 1 { 0.7 } else { 0.25 };
    // The error of a step across a jump of the gradient is proportional to its size.
    let most = [0.9, unknown][usize::from(attempts > 2)];
    let (least, most) = (T::constant(0.1, 0.0), T::constant(most, 0.0));
    let factor = root(T::constant(AIM, 0.0) / error);
    let factor = T::select(factor.lt(most), larger(factor, least), most);
    T::select(error.finite(), factor, T::constant(unknown, 0.0))
}

/// A step, as runs make it, and its estimated error, compiled once for all of the pilot.
#[inline(never)]
fn attempt<T: Real, S: System, M: Estimates<S>>(
    map: &Following<T, S, M>,
    by: T,
    t: T,
    of: &mut CarriedBy<M, S, T>,
    work: &mut WorkOf<T, S, M>,
) -> T {
    T::out_of_line(
        #[cfg_attr(not(unoptimised), inline(always))]
        || {
            let h = map.attempt(by, t, of, work);
            map.error(h, of, work)
        },
    )
}

/// Q⁴ and G.
#[inline(never)]
fn scale_at<T: Real, S: System, M: Estimates<S>>(
    map: &Following<T, S, M>,
    h: T,
    t: T,
    point: &Point<VectorOf<S, T>>,
    derivatives: &mut Derivatives<VectorOf<S, T>>,
) -> [T; 2] {
    T::out_of_line(
        #[cfg_attr(not(unoptimised), inline(always))]
        || map.scale(h, t, point, derivatives),
    )
}

/// The least factor by which a pilot may make constant steps longer.
const GAIN: f64 = 1.25;
/// The factor by which constant steps could be longer where a pilot chooses anew.
const SLACK: f64 = 4.0;

/// The lanes in which the last step, were it longer by [`SLACK`], would meet the tolerance and the time scale of the orbit.
fn is_slack<T: Real, S: System, M: Estimates<S>>(
    map: &Following<T, S, M>,
    z: &Follows<CarriedBy<M, S, T>>,
    work: &mut WorkOf<T, S, M>,
) -> T::Mask {
    let [_, _, t, _, last, ..] = z.numbers;
    let h = map.parameter * fixed(last.recip());
    let error = T::out_of_line(
        #[cfg_attr(not(unoptimised), inline(always))]
        || map.error(h, &z.of, work),
    );
    let [scale, _] = scale_at(map, h, t, z.of.point(), &mut work.derivatives);
    let longer = h.abs() * number(SLACK);
    let longest = fixed(scale.sqrt().sqrt().recip()) * number(LARGEST[1]);
    // Without forces there is no Q.
    let is_free = !scale.equals(scale);
    number::<T>(SLACK).le(factor(error, FARTHEST)) & (longer.le(longest) | is_free)
}

/// Chooses anew, in these lanes, where varying steps were refused too often some steps ago, or constant ones are shorter
/// than they need to be.
#[cold]
#[inline(never)]
pub(super) fn again<T: Real, S: System, M: Estimates<S>>(
    map: &Following<T, S, M>,
    lanes: T::Mask,
    z: &mut Follows<CarriedBy<M, S, T>>,
    work: &mut WorkOf<T, S, M>,
) {
    let [zero, one] = [T::zero(), T::one()];
    let [density, _, t, refused, _, was_limit, ..] = z.numbers;
    let was_constant = zero.lt(was_limit);
    let mut chosen = lanes & !was_constant;
    if (lanes & was_constant).any() {
        chosen = chosen | (lanes & is_slack(map, z, work));
    }
    if chosen.any() {
        let size = (map.parameter * fixed(density.recip())).abs();
        let held = T::select(was_constant, size, zero);
        let [next, rate, _, _, _, limit, _, unit, first, ..] =
            start(map, t, z.of.clone(), held).numbers;
        let gains = (next * number(GAIN)).lt(density);
        chosen = chosen & !(was_constant & zero.lt(limit) & !gains);
        // The time, its low word and the last step go on.
        for (k, fresh) in [
            (0, next),
            (1, rate),
            (3, refused + one),
            (5, limit),
            (7, unit),
            (8, first),
            (11, z.numbers[11] + one),
        ] {
            z.numbers[k] = T::select(chosen, fresh, z.numbers[k]);
        }
    }
    let is_constant = zero.lt(z.numbers[5]);
    let wait = T::select(is_constant, z.numbers[10] * number(2.0), zero);
    for k in [9, 10] {
        z.numbers[k] = T::select(lanes, wait, z.numbers[k]);
    }
}

/// The carried value at a start. Constant steps of the size `held` have met the tolerance so far; 0 if none have.
pub(super) fn start<T: Real, S: System, M: Estimates<S>>(
    map: &Following<T, S, M>,
    t: T,
    of: CarriedBy<M, S, T>,
    held: T,
) -> Follows<CarriedBy<M, S, T>> {
    let [zero, one] = [T::zero(), T::one()];
    let parameter = map.parameter;
    let half = parameter * number(0.5);
    let direction = T::select(parameter.lt(zero), -one, one);
    let mut carried = Pace {
        of,
        numbers: [zero; NUMBERS],
    };
    let mut work: WorkOf<T, S, M> = Scratch::like(&carried);

    // A first size, from the time scale of the orbit.
    let point = carried.of.point().clone();
    scale_at(map, direction, t, &point, &mut work.derivatives);
    let [short, long] = work.derivatives.times(&point, parameter).map(fixed);
    let [scale, _] = scale_at(
        map,
        direction * short * number(0.03),
        t,
        &point,
        &mut work.derivatives,
    );
    let unit = fixed(scale.sqrt().sqrt().recip());
    let usable = unit.finite() & zero.lt(unit);
    let longest = T::select(usable, unit, long);
    let largest = longest * number(LARGEST[0]);
    let mut h = direction * T::select(usable, unit * number(0.3), short * number(0.03));

    // The size with the error aimed at.
    let mut done = T::Mask::splat(false);
    work.before.copy_from(&carried.of);
    for _ in 0..TRIALS {
        let error = attempt(map, h / parameter, t, &mut carried.of, &mut work);
        carried.of.copy_from(&work.before);
        let factor = factor(error, LEAP);
        done = done | (error.le(one) & factor.le(number(1.25)));
        if done.all() {
            break;
        }
        let next = h * factor;
        let is_largest = largest.le(next.abs());
        let next = T::select(is_largest, direction * largest, next);
        done = done | (h.equals(next) & error.le(one));
        h = T::select(done, h, next);
    }

    // Steps that vary, and the sizes that each of them would have.
    let [scale, begin] = scale_at(map, h, t, &point, &mut work.derivatives);
    let begin = fixed(begin);
    let at_start = fixed(scale.sqrt().sqrt());
    let mut dense = T::select(usable, at_start, longest.recip());
    let mut trial = carried.of.clone();
    let (mut density, mut rate, mut time) = (parameter / h, begin, t);
    let [mut failed, mut over] = [T::Mask::splat(false); 2];
    let mut best = zero;
    let mut smallest = longest * number(LARGEST[1]);
    let [mut elapsed, mut varying] = [zero, zero];
    let mut worst = one;
    let mut due = number::<T>(f64::MAX);
    for followed in 1..=FOLLOWED[1] {
        density += half * rate;
        let h = parameter * fixed(density.recip());
        work.before.copy_from(&trial);
        let error = attempt(map, fixed(density.recip()), time, &mut trial, &mut work);
        failed = failed | (!over & !(error.finite() & zero.lt(density)));
        let counts = !(failed | over);
        if !counts.any() {
            break;
        }
        let factor = factor(error, FARTHEST);
        let size = h.abs() * factor;
        // A step that was much too short does not tell which one would do.
        let told = counts & size.lt(smallest) & factor.lt(number(FARTHEST));
        smallest = T::select(told, size, smallest);
        // The density that the error asks for, in units of Q. Where Q happens to vanish it is large.
        let fitting = parameter.abs() / size;
        let unit = fitting / dense;
        due = T::select(counts & unit.lt(due), unit, due);
        worst = T::select(counts & factor.le(worst), factor, worst);
        elapsed = T::select(counts, elapsed + h.abs(), elapsed);
        let steps = larger(factor.recip(), h.abs() * dense);
        varying = T::select(counts, varying + steps, varying);
        time += h;
        let [scale, found] = scale_at(map, h, time, trial.point(), &mut work.derivatives);
        rate = fixed(found);
        let now = fixed(scale.sqrt().sqrt());
        dense = T::select(now.finite() & zero.lt(now), now, dense);
        let longest = dense.recip() * number(LARGEST[1]);
        let is_shorter = counts & longest.lt(smallest) & zero.lt(longest);
        smallest = T::select(is_shorter, longest, smallest);
        let next = density + half * rate;
        // G tells nothing where Q vanishes.
        let next = T::select((fitting / number(APART)).lt(next), fitting, next);
        failed = failed | (!over & !(density * number(0.25)).lt(next + half * rate));
        density = next;
        best = larger(size, best);
        if followed >= FOLLOWED[0] {
            over = over | size.lt(best * number(0.9));
        }
    }
    // The estimate along steps that vary may be too careful for constant ones, and the pilot is short.
    let smallest = larger(held, smallest);
    let is_constant = elapsed.le(number::<T>(WORTH) * varying * smallest);
    // The density lost its way with steps of this size.
    let worst = T::select(failed, worst * number(0.5), worst);
    let size = T::select(is_constant, smallest, h.abs() * worst);
    let density = fixed(parameter.abs() / size);
    // A run whose parameter is the size makes steps of exactly that size.
    let is_parameter = (density - one).abs().lt(number(1e-6));
    let density = T::select(is_parameter, one, density);
    let due = T::select(due.lt(number(f64::MAX)), due, zero);
    let wait = T::select(is_constant, number(SOON as f64), zero);
    carried.numbers = [
        density,
        T::select(is_constant, zero, begin),
        t,
        zero,
        density,
        T::select(is_constant, density * number(DENSEST), zero),
        zero,
        due,
        due,
        wait,
        wait,
        zero,
    ];
    carried
}
