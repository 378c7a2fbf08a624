//! The conditions on a step: a small estimated error, the same H at both ends, and slopes there that fit its stages.
//!
//! Input: the points before and after a step. Output: their change in units of the tolerated one. Invariant: a step that
//! keeps H takes no derivatives if H is proven to be conserved.
//!
//! The estimate from the stages knows nothing of what lies between two of them, or beyond the last: a jump of H or of its
//! gradient, or a steep wall. Where H is not known to be conserved, the slopes at the ends are compared with the stages'.

use super::timescale::slope_at;
use super::tolerance::{Estimate, STAGES, WeightsOf, worse};
use crate::schemes::bundles::StageLayout;
use crate::systems::state::Point;
use crate::systems::system::{Dynamics, System, VectorOf};
use crate::systems::vector::Vector;
use hamiltonian_lanes::{Mask, Real};

/// The largest change of H, in units of the one by which the tolerated errors of a step change it.
const LARGEST: f64 = 4.0;
/// The rounding of H: a part of H and of Σ |xᵢ·∂H/∂xᵢ| in units of ε, and so many times what third differences of H show.
const ROUNDING: [f64; 2] = [64.0, 8.0];

#[cfg_attr(not(unoptimised), inline(always))]
fn rounding<T: Real>() -> T {
    T::constant(ROUNDING[0] * T::epsilon(), 0.0)
}

/// How the ends of steps are compared.
pub(super) struct Comparison<P> {
    /// The system, if H changes by ∂H/∂t alone.
    conserves: Option<P>,
    /// True if the slopes are compared: H is not known to be conserved.
    is_open: bool,
}

impl<P> Comparison<P> {
    pub(super) fn of<T: Real>(prepared: &P) -> Self
    where
        P: Dynamics<T> + Clone,
    {
        let of = prepared.description();
        let conserves = !of.is_forced && of.jumps == [false; 2];
        Comparison {
            conserves: conserves.then(|| prepared.clone()),
            is_open: of.is_forced || !of.is_autonomous,
        }
    }
}

/// The conditions on a step, and scratch.
pub struct StepConditions<'a, T: Real, S: System> {
    pub(super) estimate: &'a Estimate<T>,
    pub(super) field: &'a <S::Prepared<T> as Dynamics<T>>::Field,
    pub(super) scratch: &'a mut [Point<VectorOf<S, T>>; 2],
    pub(super) comparison: &'a Comparison<S::Prepared<T>>,
}

impl<T: Real, S: System> StepConditions<'_, T, S> {
    /// H, or 0 if it is not conserved.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn energy(&self, t: T, at: &Point<VectorOf<S, T>>) -> T {
        match &self.comparison.conserves {
            Some(of) => of.energy(t, &at.q, &at.p),
            None => T::zero(),
        }
    }

    /// As [`Estimates::change`](super::Estimates::change), from the slopes at the stages, or from the forces there.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn change<L: StageLayout<T>, X: Vector<Scalar = L::Bundle>>(
        &mut self,
        weights: &WeightsOf<L, T>,
        (h, t): (T, T),
        ends: [&Point<VectorOf<S, T>>; 2],
        slopes: &[X; STAGES],
        energies: [T; 2],
    ) -> T {
        let change = self.change_of_energy((h, t), ends, energies);
        if !self.comparison.is_open {
            return change;
        }
        for ((t, x), slope) in [t, t + h].into_iter().zip(ends).zip(&mut *self.scratch) {
            slope_at(self.field, t, x, slope);
        }
        let defect = (self.estimate).defect::<L, _, X>(weights, h, ends, slopes, self.scratch);
        worse(change, defect)
    }

    /// The change of H in units of the tolerated one; 0 if it is rounding, or H is not conserved.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn change_of_energy(
        &mut self,
        step: (T, T),
        ends: [&Point<VectorOf<S, T>>; 2],
        energies: [T; 2],
    ) -> T {
        let [before, after] = energies;
        let change = (after - before).abs();
        let rounding = rounding::<T>() * (before.abs() + after.abs());
        // True if H is not finite.
        let mut differs = !(change.le(rounding) & change.finite());
        if differs.any() {
            // Bounds from the mean slope, and from ∂H/∂t at the ends, suffice for most steps.
            let by = step.0.recip();
            let scratch = &mut self.scratch[0];
            scratch.set_zero();
            scratch.accumulate(by, ends[1]);
            scratch.accumulate(-by, ends[0]);
            let [tolerated, _] = self.estimate.change_of_energy(ends, scratch);
            let mut tolerated = T::constant(2.0 * LARGEST, 0.0) * tolerated;
            if let (true, Some(of)) = (self.comparison.is_open, &self.comparison.conserves) {
                let (h, t) = step;
                for (t, x) in [t, t + h].into_iter().zip(ends) {
                    let rate = of.time_derivative(t, &x.q, &x.p);
                    tolerated += T::constant(2.0, 0.0) * (h * rate).abs();
                }
            }
            differs = differs & !(change.le(tolerated) & change.finite());
        }
        if !differs.any() {
            return T::zero();
        }
        let change = self.change_beyond_rounding(step, ends, energies);
        T::select(differs, change, T::zero())
    }

    /// The lanes in which H changes by more than its derivatives explain. Near a singularity a step that is too long changes
    /// H as well, but there the slope is steep.
    #[cold]
    #[inline(never)]
    pub(super) fn jumps(
        &mut self,
        (h, t): (T, T),
        ends: [&Point<VectorOf<S, T>>; 2],
        energies: [T; 2],
    ) -> T::Mask {
        let mut explained = T::zero();
        let slope = &mut self.scratch[0];
        for (t, x) in [t, t + h].into_iter().zip(ends) {
            slope_at(self.field, t, x, slope);
            for (at, across) in [(0, VectorOf::<S, T>::PARTS), (VectorOf::<S, T>::PARTS, 0)] {
                for k in 0..VectorOf::<S, T>::PARTS {
                    for (i, slope) in slope.part(across + k).iter().enumerate() {
                        let moved = ends[1].part(at + k)[i] - ends[0].part(at + k)[i];
                        explained += (*slope * moved).abs();
                    }
                }
            }
        }
        if let Some(of) = &self.comparison.conserves {
            explained += change_in_time::<T, S>(of, (h, t), ends, slope);
        }
        explained.lt((energies[1] - energies[0]).abs())
    }

    /// The change of H in units of the one by which the tolerated errors, the rounding of H, and ∂H/∂t change it.
    #[cold]
    #[inline(never)]
    fn change_beyond_rounding(
        &mut self,
        step: (T, T),
        ends: [&Point<VectorOf<S, T>>; 2],
        energies: [T; 2],
    ) -> T {
        // A single run does this rarely, and a copy for each level would take a third of its build.
        if const { T::LANES > 1 } {
            T::out_of_line(
                #[cfg_attr(not(unoptimised), inline(always))]
                || self.change_in_bounds(step, ends, energies),
            )
        } else {
            self.change_in_bounds(step, ends, energies)
        }
    }

    /// The same, compiled where it is called.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn change_in_bounds(
        &mut self,
        (h, t): (T, T),
        ends: [&Point<VectorOf<S, T>>; 2],
        energies: [T; 2],
    ) -> T {
        let Some(of) = &self.comparison.conserves else {
            return T::zero();
        };
        let mut tolerated = T::zero();
        let scratch = &mut self.scratch[0];
        for ((t, x), energy) in [t, t + h].into_iter().zip(ends).zip(energies) {
            slope_at(self.field, t, x, scratch);
            let [change, size] = self.estimate.change_of_energy(ends, scratch);
            tolerated += T::constant(LARGEST, 0.0) * change;
            tolerated += rounding::<T>() * (size + energy.abs());
        }
        let change = (energies[1] - energies[0]).abs();
        if tolerated.lt(change).any() {
            tolerated += change_in_time::<T, S>(of, (h, t), ends, scratch);
        }
        if tolerated.lt(change).any() {
            let noise = rounding_near::<T, S>(of, [t, t + h], ends, scratch);
            tolerated += T::constant(ROUNDING[1], 0.0) * noise;
        }
        change / tolerated
    }
}

/// The point at `part` of the way through a step.
#[cfg_attr(not(unoptimised), inline(always))]
fn between<V: Vector>(ends: [&Point<V>; 2], part: V::Scalar, to: &mut Point<V>) {
    to.copy_from(ends[0]);
    to.accumulate(part, ends[1]);
    to.accumulate(-part, ends[0]);
}

/// A bound of the change of H by ∂H/∂t in a step: twice the largest of nine, along the straight line.
#[cfg_attr(not(unoptimised), inline(always))]
fn change_in_time<T: Real, S: System>(
    of: &S::Prepared<T>,
    (h, t): (T, T),
    ends: [&Point<VectorOf<S, T>>; 2],
    at: &mut Point<VectorOf<S, T>>,
) -> T {
    let mut most = T::zero();
    for k in 0..9 {
        let part = T::constant(f64::from(k) / 8.0, 0.0);
        between(ends, part, at);
        let rate = of.time_derivative(t + part * h, &at.q, &at.p);
        most = worse(most, (h * rate).abs());
    }
    // Rounding of t decides what H changes by in a shorter step.
    let shortest = T::constant(1024.0 * T::epsilon(), 0.0) * t.abs();
    let is_unknown = h.abs().lt(shortest) & !most.equals(T::zero());
    T::select(is_unknown, T::constant(f64::MAX, 0.0), most + most)
}

/// The rounding of H near the ends of a step: the largest third difference of H on either side of an end, along the line
/// through both, the smaller of both sides, since a jump lies on one. The distance of the points is ∛ε of the step, at
/// which third differences of a smooth H are rounding, and another one, since rounding may repeat itself. It is taken for 0
/// where rounding moves the points.
#[cfg_attr(not(unoptimised), inline(always))]
fn rounding_near<T: Real, S: System>(
    of: &S::Prepared<T>,
    times: [T; 2],
    ends: [&Point<VectorOf<S, T>>; 2],
    near: &mut Point<VectorOf<S, T>>,
) -> T {
    let distance = Real::exp(Real::ln(T::epsilon()) / 3.0);
    let mut sum = T::zero();
    for (end, t) in [0.0, 1.0].into_iter().zip(times) {
        let mut least = T::constant(f64::NAN, 0.0);
        for side in [-distance, distance] {
            let mut most = T::zero();
            for distance in [side, 0.625 * side] {
                let mut energies = [T::zero(); 8];
                for (k, energy) in energies.iter_mut().enumerate() {
                    let part = T::constant(distance * (k + 1) as f64, 0.0);
                    between(ends, T::constant(end, 0.0) + part, near);
                    *energy = of.energy(t, &near.q, &near.p);
                }
                for at in energies.windows(4) {
                    let third = at[3] - at[0] + T::constant(3.0, 0.0) * (at[1] - at[2]);
                    most = worse(most, third.abs());
                }
            }
            let is_less = most.lt(least) | !least.equals(least);
            least = T::select(is_less, most, least);
        }
        sum += least;
    }
    let smallest = T::constant(1024.0 * T::epsilon() / distance, 0.0);
    let mut moves = T::Mask::splat(false);
    for k in 0..Point::<VectorOf<S, T>>::PARTS {
        for (a, b) in ends[0].part(k).iter().zip(ends[1].part(k)) {
            moves = moves | (smallest * (a.abs() + b.abs())).lt((*b - *a).abs());
        }
    }
    T::select(moves, sum, T::zero())
}
