//! The density of steps, which follows the time scale of the orbit.
//!
//! Input: the numbers that [`Adaptive`](super::Adaptive) carries, and the point after a step. Output: the density in the
//! next step. Invariant: in steps that are not refused it is reversible, but where it leaves Q by a factor or falls too
//! fast.

use super::inspection::{Estimates, Sizes};
use super::timescale::Derivatives;
use super::tolerance::larger;
use super::{Following, NUMBERS, fixed};
use crate::schemes::paced::SOON;
use crate::systems::state::Point;
use crate::systems::system::{System, VectorOf};
use hamiltonian_lanes::{Mask, Real};

/// The density of steps follows Q up to this factor, and its inverse.
pub(super) const APART: f64 = 0.25;
/// The factor of ρ/Q after a refused step, and the most after all of them.
const HIGHER: [f64; 2] = [1.125, 8.0];
/// The factor of ρ/Q after which a pilot chooses anew.
const SHORT: f64 = 2.0;
/// The most by which a step is longer than the density at its beginning says.
const LONGER: f64 = 3.0;

/// Lets a pilot choose anew where steps were refused too often, later after each pilot.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn wait<T: Real>(numbers: &mut [T; NUMBERS], lanes: T::Mask) {
    let soon = T::constant(SOON as f64, 0.0) * (numbers[11] + T::one());
    for k in [9, 10] {
        numbers[k] = T::select(lanes, soon, numbers[k]);
    }
}

/// The sizes of steps in lanes, which follow the orbit if they vary.
pub(super) struct OrbitSizes<'a, T: Real, S: System, M: Estimates<S>> {
    pub(super) map: &'a Following<T, S, M>,
    pub(super) numbers: &'a mut [T; NUMBERS],
    pub(super) derivatives: &'a mut Derivatives<VectorOf<S, T>>,
    /// The density in this step, and its inverse.
    pub(super) density: T,
    pub(super) size: T,
    pub(super) is_constant: bool,
}

impl<T: Real, S: System, M: Estimates<S>> Sizes<T, VectorOf<S, T>> for OrbitSizes<'_, T, S, M> {
    #[cfg_attr(not(unoptimised), inline(always))]
    fn size(&self) -> T {
        self.size
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn next(&mut self, time: [T; 2], point: &Point<VectorOf<S, T>>) -> bool {
        [self.numbers[2], self.numbers[6]] = time;
        if self.is_constant {
            return true;
        }
        let none = T::Mask::splat(false);
        (self.map).follow(self.density, none, self.numbers, point, self.derivatives);
        let (density, leaps) = self.map.density(self.numbers);
        (self.density, self.size) = (density, fixed(density.recip()));
        !leaps.any()
    }
}

impl<T: Real, S: System, M: Estimates<S>> Following<T, S, M> {
    /// The density in the next step, and the lanes in which that after the last one lies too far above it.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn density(&self, numbers: &[T; NUMBERS]) -> (T, T::Mask) {
        let [before, rate, _, _, _, limit, ..] = *numbers;
        let half = self.parameter * T::constant(0.5, 0.0);
        let density = before + half * rate;
        // A step is at most so many times longer than the density says: an estimate is worth nothing far beyond.
        let least = before * T::constant(LONGER.recip(), 0.0);
        let leaps = !least.le(density) & !T::zero().lt(limit);
        (T::select(leaps, least, density), leaps)
    }

    /// Finds the density after a step with this one; `changed` are lanes in which a size was refused.
    ///
    /// Rare cases are branches, so that the next step need not wait for them.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn follow(
        &self,
        made: T,
        changed: T::Mask,
        numbers: &mut [T; NUMBERS],
        point: &Point<VectorOf<S, T>>,
        derivatives: &mut Derivatives<VectorOf<S, T>>,
    ) {
        let [zero, one] = [T::zero(), T::one()];
        let [
            _,
            mut rate,
            end,
            mut refused,
            _,
            limit,
            low,
            mut unit,
            mut first,
            ..,
        ] = *numbers;
        let half = self.parameter * T::constant(0.5, 0.0);
        let is_constant = zero.lt(limit);
        let h = self.parameter * fixed(made.recip());
        let mut density = made;
        if !is_constant.all() {
            let [scale, found] = self.scale(h, end, point, derivatives);
            rate = T::select(is_constant, zero, fixed(found));
            let dense = fixed(scale.sqrt().sqrt());
            let is_known = zero.lt(dense) & dense.finite() & !is_constant;
            let here = density + half * rate;
            let is_first = is_known & unit.equals(zero);
            if is_first.any() {
                first = T::select(is_first, here / dense, first);
                unit = T::select(is_first, first, unit);
            }
            let is_higher = is_known & changed;
            if is_higher.any() {
                let higher = unit * T::constant(HIGHER[0], 0.0);
                let highest = first * T::constant(HIGHER[1], 0.0);
                let higher = T::select(higher.lt(highest), higher, highest);
                unit = T::select(is_higher, higher, unit);
                let is_short = is_higher & (first * T::constant(SHORT, 0.0)).lt(unit);
                wait(numbers, is_short);
            }
            let due = unit * dense;
            let apart = T::constant(APART, 0.0);
            let astray = is_known & !((due * apart).le(here) & (here * apart).le(due));
            density = here;
            if astray.any() {
                refused += T::select(astray, one, zero);
                // Sparser steps come one by one.
                let less = here * T::constant(0.5, 0.0);
                density = T::select(astray, larger(due, less), here);
            }
        }
        let now = [density, rate, end, refused, made, limit, low, unit, first];
        numbers[..now.len()].copy_from_slice(&now);
    }

    /// Q⁴ and G, with differences over 1/32 of a step.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn scale(
        &self,
        h: T,
        t: T,
        point: &Point<VectorOf<S, T>>,
        derivatives: &mut Derivatives<VectorOf<S, T>>,
    ) -> [T; 2] {
        let tau = h * T::constant(1.0 / 32.0, 0.0);
        if M::IS_OF_SECOND_ORDER {
            derivatives.scale::<_, true>(&self.field, t, point, tau)
        } else {
            derivatives.scale::<_, false>(&self.field, t, point, tau)
        }
    }
}
