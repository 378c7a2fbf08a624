//! What is asked of a step: a small estimated error, the same H at both ends, and slopes there that fit its stages.
//!
//! Input: the points before and after a step. Output: their change in units of the tolerated one. Invariant: a step that
//! keeps a conserved H takes no derivatives.
//!
//! The estimate from the stages knows nothing of what lies between two of them, or beyond the last: a jump of H or of its
//! gradient, or a steep wall. Where H is not known to be conserved, the slopes at the ends are compared with the stages'.

use super::timescale::slope_at;
use super::tolerance::{Estimate, STAGES, WeightsOf, larger, worse};
use crate::schemes::bundles::StageLayout;
use crate::systems::state::Point;
use crate::systems::system::{Dynamics, System, VectorOf};
use crate::systems::vector::Vector;
use hamiltonian_lanes::{Mask, Real};

/// The largest change of H, in units of the one by which the tolerated errors of a step change it.
const LARGEST: f64 = 4.0;
/// The rounding of H: a part of H and of Σ |xᵢ·∂H/∂xᵢ| in units of ε, and so many times what third differences of H show.
const ROUNDING: [f64; 2] = [64.0, 8.0];
/// The relative distance of the points of third differences: 2⁻¹⁷, at which those of a smooth H are rounding.
const NEAR: f64 = 1.0 / (1_u64 << 17) as f64;

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

/// What is asked of a step: a small estimated error, and the same H at both ends.
pub struct Asked<'a, T: Real, S: System> {
    pub(super) estimate: &'a Estimate<T>,
    pub(super) field: &'a <S::Prepared<T> as Dynamics<T>>::Field,
    pub(super) scratch: &'a mut [Point<VectorOf<S, T>>; 2],
    pub(super) comparison: &'a Comparison<S::Prepared<T>>,
}

impl<T: Real, S: System> Asked<'_, T, S> {
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
        // False for NaN, of a step that was not solved.
        let mut differs = rounding.lt(change);
        if differs.any() {
            // The mean slope tells most steps apart, and needs no derivatives.
            let by = step.0.recip();
            let scratch = &mut self.scratch[0];
            scratch.set_zero();
            scratch.accumulate(by, ends[1]);
            scratch.accumulate(-by, ends[0]);
            let [tolerated, _] = self.estimate.change_of_energy(ends, scratch);
            differs = differs & !change.le(T::constant(2.0 * LARGEST, 0.0) * tolerated);
        }
        if !differs.any() {
            return T::zero();
        }
        let change = self.change_beyond_rounding(step, ends, energies);
        T::select(differs, change, T::zero())
    }

    /// The lanes in which H changes by more than its slope at the ends tells: near a singularity H changes too, in steps that
    /// are too long for it, but so does its slope.
    #[cold]
    #[inline(never)]
    pub(super) fn jumps(
        &mut self,
        (h, t): (T, T),
        ends: [&Point<VectorOf<S, T>>; 2],
        energies: [T; 2],
    ) -> T::Mask {
        let mut told = T::zero();
        let slope = &mut self.scratch[0];
        for (t, x) in [t, t + h].into_iter().zip(ends) {
            slope_at(self.field, t, x, slope);
            for (at, across) in [(0, VectorOf::<S, T>::PARTS), (VectorOf::<S, T>::PARTS, 0)] {
                for k in 0..VectorOf::<S, T>::PARTS {
                    for (i, slope) in slope.part(across + k).iter().enumerate() {
                        let moved = ends[1].part(at + k)[i] - ends[0].part(at + k)[i];
                        told += (*slope * moved).abs();
                    }
                }
            }
        }
        told.lt((energies[1] - energies[0]).abs())
    }

    /// The change of H in units of the one by which the tolerated errors, the rounding of H, and ∂H/∂t change it.
    #[cold]
    #[inline(never)]
    fn change_beyond_rounding(
        &mut self,
        (h, t): (T, T),
        ends: [&Point<VectorOf<S, T>>; 2],
        energies: [T; 2],
    ) -> T {
        let Some(of) = &self.comparison.conserves else {
            return T::zero();
        };
        T::out_of_line(
            #[cfg_attr(not(unoptimised), inline(always))]
            || {
                let mut tolerated = T::zero();
                let scratch = &mut self.scratch[0];
                for ((t, x), energy) in [t, t + h].into_iter().zip(ends).zip(energies) {
                    slope_at(self.field, t, x, scratch);
                    let [change, size] = self.estimate.change_of_energy(ends, scratch);
                    tolerated += T::constant(LARGEST, 0.0) * change;
                    tolerated += rounding::<T>() * (size + energy.abs());
                    tolerated += (h * of.time_derivative(t, &x.q, &x.p)).abs();
                }
                let change = (energies[1] - energies[0]).abs();
                if tolerated.lt(change).any() {
                    for (t, x) in [t, t + h].into_iter().zip(ends) {
                        tolerated +=
                            T::constant(ROUNDING[1], 0.0) * rounding_at::<T, S>(of, t, x, scratch);
                    }
                }
                change / tolerated
            },
        )
    }
}

/// The rounding of H near a point: the largest third difference of H on either side of it, the smaller of both, since a
/// jump lies on one side.
#[cfg_attr(not(unoptimised), inline(always))]
fn rounding_at<T: Real, S: System>(
    of: &S::Prepared<T>,
    t: T,
    point: &Point<VectorOf<S, T>>,
    near: &mut Point<VectorOf<S, T>>,
) -> T {
    let mut least = T::constant(f64::MAX, 0.0);
    for side in [-1.0, 1.0] {
        let mut energies = [T::zero(); 6];
        for (k, energy) in energies.iter_mut().enumerate() {
            near.set_zero();
            let by = T::one() + T::constant(side * NEAR * (k + 1) as f64, 0.0);
            near.accumulate(by, point);
            *energy = of.energy(t, &near.q, &near.p);
        }
        let mut most = T::zero();
        for at in energies.windows(4) {
            let third = at[3] - at[0] + T::constant(3.0, 0.0) * (at[1] - at[2]);
            most = larger(most, third.abs());
        }
        least = T::select(most.lt(least), most, least);
    }
    least
}
