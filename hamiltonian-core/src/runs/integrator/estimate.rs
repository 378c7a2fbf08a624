//! The error of a run, estimated before it is made.
//!
//! Input: a run, the number of steps planned. Output: [`ErrorEstimate`], from the same run with the step, half
//! of it and a quarter. Invariant: the run itself is not changed.

use super::{Integrator, MapOf, duration};
use crate::errors::{Error, TimeError};
use crate::flows::map::{Clock, Step};
use crate::results::checkpoint::Memory;
use crate::systems::flow::Scratch;
use crate::systems::state::{Carried, State};
use crate::systems::system::{System, VectorOf};
use crate::systems::vector::Vector;
use alloc::sync::Arc;
use hamiltonian_lanes::Real;

/// The error of a run, estimated by halving the step; see [`Integrator::estimate_error`].
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorEstimate<V: Vector> {
    /// The state at the end of the planned run, with its own step.
    pub end: State<V>,
    /// The estimated error of that state: the largest of the errors of its components.
    pub error: f64,
    /// The estimated error of H at the end.
    pub energy_error: f64,
    /// The observed order p of `error` = O(hᵖ). NaN if steps make no difference.
    ///
    /// If it is far from the order of the [entry](crate::schemes::author::Entry), the estimates are
    /// not reliable: the step is too long for the asymptotic error, errors are those of rounding,
    /// or the orbit is chaotic and the run is longer than its predictable time.
    pub order: f64,
}

/// The error of the first of three values with steps that halve, and the order, from the two
/// differences.
///
/// Errors e, 2⁻ᵖe, 4⁻ᵖe have the differences a = (1 − 2⁻ᵖ)e and b = 2⁻ᵖa, so e = a²/(a − b).
fn extrapolated(a: f64, b: f64) -> (f64, f64) {
    // At order 1/2 and below no scheme of this library converges.
    let converges = a > core::f64::consts::SQRT_2 * b;
    let error = if converges { a * a / (a - b) } else { a.max(b) };
    (error, Real::ln(a / b) / core::f64::consts::LN_2)
}

impl<T: Real, S: System, R: MapOf<T, S>, O> Integrator<T, S, R, O> {
    /// Estimates the error of the next `n` steps. Temporary runs make them, then 2n steps of half the size and 4n of a
    /// quarter, all from the current state. This takes seven times as long as the steps themselves. The run does not
    /// change.
    ///
    /// With the end points z(h), z(h/2), z(h/4) and the differences a = |z(h) − z(h/2)| and
    /// b = |z(h/2) − z(h/4)| in the maximum norm, the observed order is log₂(a/b) and the error of z(h)
    /// a²/(a − b). If a ≤ √2 b, the error is the larger difference, a lower bound. H at the end is treated
    /// likewise; [`EnergyDrift`](crate::observers::EnergyDrift) measures it along a run.
    ///
    /// Source: L. F. Richardson, Philos. Trans. R. Soc. A 226 (1927) 299, doi:10.1098/rsta.1927.0008.
    ///
    /// ```
    #[doc = include_str!("../../doc/oscillator.md")]
    ///
    /// let start = State::new([1.0], [0.0]);
    /// let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), start, 0.01)?;
    /// let estimate = run.estimate_error(100)?;
    /// assert!((estimate.order - 2.0).abs() < 0.01);
    ///
    /// let end = run.advance(100)?;
    /// assert_eq!(end, &estimate.end);
    /// let error = (end.q[0] - 1.0_f64.cos()).abs().max((end.p[0] + 1.0_f64.sin()).abs());
    /// assert!((estimate.error / error - 1.0).abs() < 0.01);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`TimeError::Uneven`] for a scheme whose steps vary in time; those of
    /// [`advance`](Integrator::advance).
    pub fn estimate_error(&self, n: u64) -> Result<ErrorEstimate<VectorOf<S, T>>, Error> {
        if self.carried.duration(self.clock.interval).is_some() {
            return Err(TimeError::Uneven.into());
        }
        let part = |parts: u32| -> Result<(State<VectorOf<S, T>>, T), Error> {
            let step = self.step / T::constant(f64::from(parts), 0.0);
            let mut run = self.restarted(step);
            run.advance(n.saturating_mul(u64::from(parts)))?;
            Ok((run.state.clone(), run.energy()))
        };
        let (end, energy) = part(1)?;
        let (half, half_energy) = part(2)?;
        let (quarter, quarter_energy) = part(4)?;
        let (error, order) = extrapolated(apart(&end, &half), apart(&half, &quarter));
        let (energy_error, _) = extrapolated(
            (energy - half_energy).magnitude(),
            (half_energy - quarter_energy).magnitude(),
        );
        Ok(ErrorEstimate {
            end,
            error,
            energy_error,
            order,
        })
    }

    /// A run of the same scheme from the current state with another step and without observers.
    fn restarted(&self, step: T) -> Integrator<T, S, R> {
        let carried = self.recipe.start(&self.prepared, &self.state, step);
        Integrator {
            prepared: self.prepared.clone(),
            recipe: Arc::clone(&self.recipe),
            entry: self.entry,
            map: self.recipe.prepare(&self.prepared, Step::of(step)),
            work: Scratch::like(&carried),
            snapshot: carried.clone(),
            shown: carried.clone(),
            carried,
            clock: Clock::new(self.state.t, step * duration(&self.entry)),
            step,
            began: 0,
            steps: 0,
            state: self.state.clone(),
            ended: false,
            memory: Memory::default(),
            refused: None,
            #[cfg(feature = "std")]
            saving: None,
            parameters: self.parameters.clone(),
            #[cfg(feature = "rayon")]
            threads: self.threads.clone(),
            observer: (),
        }
    }
}

/// The largest difference of components.
fn apart<V: Vector>(a: &State<V>, b: &State<V>) -> f64 {
    let q = a.q.components().zip(b.q.components());
    let p = a.p.components().zip(b.p.components());
    q.chain(p)
        .map(|(a, b)| (a - b).magnitude())
        .fold(0.0, f64::max)
}
