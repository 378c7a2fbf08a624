//! Runs whose scheme and steps follow from a tolerance.
//!
//! Input: a system that names a scheme, a start and a tolerance. Output: a run. Invariant: the step parameter of the run
//! is the first step of the pilot, so that constant steps have the coefficients of the scheme itself.

use super::{Integrator, MapOf, check_scheme, check_start};
use crate::errors::Error;
use crate::flows::map::Map;
use crate::schemes::scheme::{CarriedBy, Scheme};
use crate::schemes::{Adaptive, ToTolerance, Tolerance};
use crate::systems::state::{Carried, IntoStart};
use crate::systems::system::{System, VectorOf};
use hamiltonian_lanes::Real;

impl<T: Real, S: ToTolerance, R: MapOf<T, S>> Integrator<T, S, R> {
    /// Creates a run with steps from a tolerance, by the scheme that [`ToTolerance`] names for the system. See
    /// [`Adaptive`] for the choice of steps, and [`Tolerance`] for the norm of their errors; a number is a relative
    /// tolerance.
    ///
    /// The tolerance is that of one step. The error of the end of a run is larger: it grows with the number of steps, and
    /// with the factor by which the system magnifies a deviation.
    ///
    /// ```
    #[doc = include_str!("../../doc/oscillator.md")]
    ///
    /// let mut run = Integrator::to_tolerance(&Oscillator {}, State::new([1.0], [0.0]), 1e-10)?;
    /// for state in run.states_at([0.1, 1.0, 20.0]) {
    ///     let state = state?;
    ///     assert!((state.q[0] - state.t.cos()).abs() < 1e-9);
    /// }
    /// assert!(run.steps() < 30 && run.refused_steps() == 0);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// To integrate backwards, change the sign of the step before the first one:
    ///
    /// ```
    #[doc = include_str!("../../doc/oscillator.md")]
    ///
    /// let mut run = Integrator::to_tolerance(&Oscillator {}, State::new([1.0], [0.0]), 1e-10)?;
    /// run.change_step(-run.step())?;
    /// let state = run.advance_until(-3.0)?;
    /// assert!((state.p[0] - 3.0_f64.sin()).abs() < 1e-9);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`StartError::Tolerance`](crate::errors::StartError::Tolerance) for a tolerance that is not positive, and those of
    /// [`Integrator::new`].
    pub fn to_tolerance(
        system: &S,
        start: impl IntoStart<VectorOf<S, T>>,
        tolerance: impl Into<Tolerance>,
    ) -> Result<Self, Error>
    where
        Adaptive<S::Scheme>: Scheme<S, Map<T> = R>,
        R: Map<Carried = CarriedBy<Adaptive<S::Scheme>, S, T>>,
    {
        let start = start.into_start(system.description().first_names())?;
        let scheme = Adaptive::new(S::Scheme::default(), tolerance);
        let prepared = check_start(system, &start)?;
        check_scheme(&scheme, &prepared, &start)?;
        // The first step becomes the parameter.
        let one = T::one();
        let mut carried = scheme.start(&prepared, &start, one);
        let step = carried.duration(one).unwrap_or(one);
        carried.rescale(step);
        Ok(Self::begin_with(
            system, prepared, scheme, start, step, carried,
        ))
    }
}

impl<T: Real, S: System, R: MapOf<T, S>, O> Integrator<T, S, R, O> {
    /// Returns how often a size of a step was refused, or the density of steps set anew, in a run of [`Adaptive`]; 0 in
    /// runs of other schemes. In several lanes, the number of the first.
    pub fn refused_steps(&self) -> u64 {
        self.carried.refused()
    }
}
