//! Long runs whose steps follow from a tolerance of H.
//!
//! Input: a system in pieces, a start and a tolerance. Output: a run of fixed steps. Invariant: the choice depends on the
//! start alone, and the steps are those of the scheme, so that the run is symplectic.

use super::{Integrator, MapOf, check_scheme, check_start};
use crate::errors::{Error, StepError};
use crate::flows::map::Map;
use crate::schemes::scheme::{CarriedBy, Scheme};
use crate::schemes::{BlanesMoan6, Tolerance};
use crate::systems::state::{IntoStart, State};
use crate::systems::system::{
    Autonomous, Dynamics, Split, System, Unforced, VectorOf, declared_energy,
};
use crate::systems::vector::{Vector, dot};
use hamiltonian_lanes::Real;

/// The order of the scheme, and of its error of H.
const ORDER: f64 = 6.0;
/// The steps of a pilot, and of the last one, which confirms the size.
const PILOT: [u64; 2] = [2_048, 16_384];
/// The error of H that a size aims at, in units of the tolerated one: it may be larger after the pilot.
const AIM: f64 = 0.5;
/// The largest factor between two sizes, and the one that is not worth another pilot.
const FACTORS: [f64; 2] = [4.0, 1.15];
/// The most pilots, and the most whose errors are hardly smaller than those of longer steps.
const ATTEMPTS: [u32; 2] = [40, 4];

impl<T: Real, S: Split + Autonomous + Unforced, R: MapOf<T, S>> Integrator<T, S, R> {
    /// Creates a run for long times, of [`BlanesMoan6`] with a fixed step whose error of H stays below a tolerance: a
    /// number is relative to H at the start.
    ///
    /// ```text
    /// |H(q, p) − H₀| ≤ absolute + relative·|H₀|
    /// ```
    ///
    /// The error of H of a symplectic scheme does not grow over exponentially long times, as long as the step is short
    /// enough for the motion. Pilots of 2 048 steps from the start look for the size whose largest error is half of the
    /// tolerated one, and a pilot of 16 384 steps confirms it. What the orbit meets only later, such as a close encounter,
    /// they do not see: attach an [`EnergyDrift`](crate::observers::EnergyDrift). The error of the orbit itself grows with
    /// time: for a small one, use [`to_tolerance`](Integrator::to_tolerance).
    ///
    /// Source: E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration (2006), theorem IX.8.1,
    /// doi:10.1007/3-540-30666-8.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    ///
    /// let h = hamiltonian! { H = 0.5*(q^2 + 1)*(p^2 + 1) };
    /// let mut run = Integrator::to_tolerance_long(&h, State::new([1.0], [0.0]), 1e-6)?
    ///     .observe(EnergyDrift::new());
    /// run.advance(50_000)?;
    /// assert!(run.observer().max_relative() < 1e-6);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`StartError::Tolerance`](crate::errors::StartError::Tolerance) for a tolerance that is not positive,
    /// [`StepError::Refused`] for one that no step meets, for example below the rounding of H, and those of
    /// [`Integrator::new`].
    pub fn to_tolerance_long(
        system: &S,
        start: impl IntoStart<VectorOf<S, T>>,
        tolerance: impl Into<Tolerance>,
    ) -> Result<Self, Error>
    where
        BlanesMoan6: Scheme<S, Map<T> = R>,
        R: Map<Carried = CarriedBy<BlanesMoan6, S, T>>,
    {
        let tolerance = tolerance.into();
        tolerance.check()?;
        let start = start.into_start(system.description().first_names())?;
        let prepared = check_start(system, &start)?;
        check_scheme(&BlanesMoan6, &prepared, &start)?;
        let energy = declared_energy::<T, S>(&prepared, &start);
        let most = tolerance.absolute + tolerance.relative * energy.magnitude();
        let new = |step: f64| {
            let step = T::constant(step, 0.0);
            Self::begin(system, prepared.clone(), BlanesMoan6, start.clone(), step)
        };
        let mut step = 0.1 * time_scale::<T, S>(&prepared, &start);
        // The largest size that a pilot has met the tolerance with, and the smallest that it has not.
        let (mut met, mut missed) = (0.0, f64::INFINITY);
        let (mut before, mut stalls) = (f64::INFINITY, 0);
        for _ in 0..ATTEMPTS[0] {
            let error = new(step).largest_error(energy, PILOT[0]);
            let factor = Real::exp(Real::ln(AIM * most / error) / ORDER);
            // An error of 0 is the first case, one that is not finite the second.
            let factor = factor.min(FACTORS[0]);
            let factor = if factor > 1.0 / FACTORS[0] {
                factor
            } else {
                1.0 / FACTORS[0]
            };
            let next = step * factor;
            if error <= most {
                met = step;
            } else {
                missed = step;
                stalls += u32::from(error > 0.5 * before);
            }
            if stalls == ATTEMPTS[1] {
                break;
            }
            before = error;
            // A point at rest has no error.
            let is_near = error <= most && (factor <= FACTORS[1] || next >= missed || error == 0.0);
            if is_near && new(met).largest_error(energy, PILOT[1]) <= most {
                return Ok(new(met));
            }
            step = match is_near {
                // Later steps had larger errors.
                true => met / FACTORS[1],
                false => next,
            };
        }
        Err(StepError::Refused {
            step: 1,
            lane: None,
            clock: prepared.description().clock().into(),
            time: start.t.to_f64(),
            relative: tolerance.relative,
            absolute: tolerance.absolute,
        }
        .into())
    }

    /// The largest error of H after each of the next `n` steps; infinite if one fails.
    fn largest_error(&mut self, energy: T, n: u64) -> f64 {
        let mut most: f64 = 0.0;
        for _ in 0..n {
            if self.advance(1).is_err() {
                return f64::INFINITY;
            }
            most = most.max((self.energy() - energy).magnitude());
        }
        most
    }
}

/// The smaller of |q|/|q̇| and |p|/|ṗ| that is a positive number; 1 if none is.
fn time_scale<T: Real, S: System>(prepared: &S::Prepared<T>, start: &State<VectorOf<S, T>>) -> f64 {
    let State { t, q, p } = start;
    let (mut dq, mut dp) = (q.zeros_like(), p.zeros_like());
    prepared.gradient(*t, q, p, &mut dp, &mut dq);
    let time = |x: &VectorOf<S, T>, slope: &VectorOf<S, T>| {
        (dot(x, x) / dot(slope, slope)).sqrt().magnitude()
    };
    let times = [time(q, &dq), time(p, &dp)];
    let is_time = |time: &f64| *time > 0.0 && time.is_finite();
    let least = times
        .into_iter()
        .filter(is_time)
        .fold(f64::INFINITY, f64::min);
    if least.is_finite() { least } else { 1.0 }
}
