//! The pilot: a few steps from the start, which choose the size of steps and whether it varies.
//!
//! Input: a start. Output: the numbers with which a run begins. Invariant: the pilot depends on the start alone, and
//! makes at most 16 steps.

use super::{AIM, Derivatives, Following, Follows, NUMBERS, WorkOf, fixed, larger, root};
use crate::schemes::adaptive::Estimates;
use crate::schemes::paced::Pace;
use crate::schemes::scheme::CarriedBy;
use crate::systems::flow::Scratch;
use crate::systems::state::{Carried, Point};
use crate::systems::system::{System, VectorOf};
use crate::systems::vector::Vector;
use hamiltonian_lanes::{Mask, Real};

/// The most steps that look for the first size, and the steps that follow.
const TRIALS: [u32; 2] = [6, 10];
/// The largest first step, and the largest constant one, in units of 1/Q. Longer ones do not show how Q varies along the
/// orbit, and their equations take many iterations.
const LARGEST: [f64; 2] = [1.0, 1.5];
/// The largest factor between a size and the one with the error aimed at.
const FARTHEST: f64 = 4.0;
/// Constant steps may be so many times as many as varying ones, which cost more each.
const WORTH: f64 = 2.0;
/// The largest density with constant steps, in units of the first: the second halving is above it.
const HALVINGS: f64 = 2.5;

#[inline(always)]
fn number<T: Real>(x: f64) -> T {
    T::constant(x, 0.0)
}

/// The factor of a size by which its error becomes the one aimed at.
fn factor<T: Real>(error: T) -> T {
    let [least, most] = [number::<T>(0.1), number::<T>(FARTHEST)];
    let factor = root(number::<T>(AIM) / error);
    // An error of 0, or one too small to be divided by, is the first case.
    let factor = T::select(factor.lt(most), factor, most);
    let factor = T::select(factor.lt(least), least, factor);
    T::select(error.finite(), fixed(factor), number(0.25))
}

/// A step, as runs make it, compiled once for all of the pilot.
#[inline(never)]
fn attempt<T: Real, S: System, M: Estimates<S>>(
    map: &Following<T, S, M>,
    by: T,
    t: T,
    of: &mut CarriedBy<M, S, T>,
    work: &mut WorkOf<T, S, M>,
) -> T {
    map.attempt(by, t, of, work)
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
    map.scale(h, t, point, derivatives)
}

/// Chooses anew for the lanes in which constant steps were refused too often.
#[cold]
#[inline(never)]
pub(super) fn again<T: Real, S: System, M: Estimates<S>>(
    map: &Following<T, S, M>,
    lanes: T::Mask,
    z: &mut Follows<CarriedBy<M, S, T>>,
) {
    let [density, _, t, ..] = z.numbers;
    let mut fresh = start(map, t, z.of.clone()).numbers;
    // Sizes do not grow: a larger one was refused.
    let grown = fresh[0].lt(density);
    for (k, now) in z.numbers.iter_mut().enumerate() {
        match k {
            0 => fresh[k] = T::select(grown, density, fresh[k]),
            3 => {
                fresh[k] = T::select(
                    grown & T::zero().lt(fresh[k]),
                    density * number(HALVINGS),
                    fresh[k],
                )
            }
            // The time, its low word and the count go on.
            2 | 4 | 5 => continue,
            _ => {}
        }
        *now = T::select(lanes, fresh[k], *now);
    }
}

/// The carried value at a start.
pub(super) fn start<T: Real, S: System, M: Estimates<S>>(
    map: &Following<T, S, M>,
    t: T,
    of: CarriedBy<M, S, T>,
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
    let slow = work.derivatives.slowness(&point, parameter);
    let [scale, _] = scale_at(
        map,
        fixed(direction * slow * number(0.03)),
        t,
        &point,
        &mut work.derivatives,
    );
    let unit = fixed(scale.sqrt().sqrt().recip());
    let usable = unit.finite() & zero.lt(unit);
    let largest = T::select(usable, unit * number(LARGEST[0]), number(f64::MAX));
    let mut h = direction * T::select(usable, unit * number(0.3), slow * number(0.03));

    // The size with the error aimed at.
    let mut done = T::Mask::splat(false);
    work.before.copy_from(&carried.of);
    for _ in 0..TRIALS[0] {
        let error = attempt(map, h / parameter, t, &mut carried.of, &mut work);
        carried.of.copy_from(&work.before);
        let factor = factor(error);
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
    let mut dense = at_start;
    let mut trial = carried.of.clone();
    let (mut density, mut rate, mut time) = (parameter / h, begin, t);
    let mut failed = T::Mask::splat(false);
    let mut smallest = T::select(usable, unit * number(LARGEST[1]), number(f64::MAX));
    let [mut elapsed, mut varying] = [zero, zero];
    let mut worst = one;
    for _ in 0..TRIALS[1] {
        density += half * rate;
        let h = parameter * fixed(density.recip());
        work.before.copy_from(&trial);
        let error = attempt(map, fixed(density.recip()), time, &mut trial, &mut work);
        failed = failed | !error.finite() | !zero.lt(density);
        if failed.all() {
            break;
        }
        let factor = factor(error);
        let best = h.abs() * factor;
        // A step that was much too short does not tell which one would do.
        let told = !failed & best.lt(smallest) & factor.lt(number(FARTHEST));
        smallest = T::select(told, best, smallest);
        worst = T::select(failed | worst.lt(factor), worst, factor);
        elapsed = T::select(failed, elapsed, elapsed + h.abs());
        let steps = larger(factor.recip(), h.abs() * dense);
        varying = T::select(failed, varying, varying + steps);
        time += h;
        let [scale, found] = scale_at(map, h, time, trial.point(), &mut work.derivatives);
        rate = fixed(found);
        let now = fixed(scale.sqrt().sqrt());
        dense = T::select(now.finite(), now, dense);
        let longest = dense.recip() * number(LARGEST[1]);
        smallest = T::select(longest.lt(smallest) & zero.lt(longest), longest, smallest);
        let next = density + half * rate;
        failed = failed | !(density * number(0.25)).lt(next + half * rate);
        density = next;
    }
    let is_constant = elapsed.le(number::<T>(WORTH) * varying * smallest);
    // If not even the first step was made, it was of a size that was not refused.
    let smallest = T::select(smallest.lt(number(f64::MAX)), smallest, h.abs());
    // The density lost its way with steps of this size.
    let worst = T::select(failed, worst * number(0.5), worst);
    let size = T::select(is_constant, smallest, h.abs() * worst);
    let density = fixed(parameter.abs() / size);
    // A run whose parameter is the size makes steps of exactly that size.
    let is_parameter = (density - one).abs().lt(number(1e-6));
    let density = T::select(is_parameter, one, density);
    carried.numbers = [
        density,
        T::select(is_constant, zero, begin),
        t,
        T::select(is_constant, density * number(HALVINGS), zero),
        zero,
        zero,
        T::select(usable, density / at_start, one),
        T::select(usable, density / at_start, one),
    ];
    carried
}
