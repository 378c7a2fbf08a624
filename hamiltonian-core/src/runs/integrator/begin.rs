//! The beginning of a run.
//!
//! Input: a system, a scheme, a start and a step. Output: the run. Invariant: a start that is refused makes no run.

use super::{Integrator, MapOf, check_scheme, check_start, check_step, duration, parameters};
use crate::errors::Error;
use crate::flows::map::{Clock, Map, Step};
use crate::results::checkpoint::Memory;
use crate::schemes::scheme::{CarriedBy, Scheme};
use crate::systems::flow::Scratch;
use crate::systems::state::{IntoStart, State};
use crate::systems::system::{System, VectorOf};
use alloc::sync::Arc;
use hamiltonian_lanes::Real;

impl<T: Real, S: System, R: MapOf<T, S>> Integrator<T, S, R> {
    /// Creates a run of `scheme` on `system` from `start` with the step size `step`. A negative step integrates
    /// backwards.
    ///
    /// Time begins at 0, or at the time of the start, `State::new(q, p).at(t)`. After k steps it is t₀ + k·`step`, never
    /// a running sum.
    ///
    /// # Errors
    /// [`StartError::Step`](crate::errors::StartError::Step) for a zero, NaN or infinite step;
    /// [`InputError::Shape`](crate::errors::InputError::Shape), [`InputError::Extent`](crate::errors::InputError::Extent)
    /// and [`InputError::Row`](crate::errors::InputError::Row) if `start` does not have the system's shape;
    /// [`StartError::NotFinite`](crate::errors::StartError::NotFinite) if it is not finite;
    /// [`StartError::Values`](crate::errors::StartError::Values) if H or a derivative of it is not finite there;
    /// [`StartError::Shell`](crate::errors::StartError::Shell) for a time-transformed system (`dt = g*ds`,
    /// [`TimeTransformed`](crate::TimeTransformed)) if the start is off the shell H = 0 by more than a thousandth of the
    /// energies in it;
    /// [`StartError::Jumps`](crate::errors::StartError::Jumps) for a scheme that evaluates H(t) at the ends of steps,
    /// if H jumps; those of [`Scheme::check`].
    pub fn new<M: Scheme<S, Map<T> = R>>(
        system: &S,
        scheme: M,
        start: impl IntoStart<VectorOf<S, T>>,
        step: T,
    ) -> Result<Self, Error>
    where
        R: Map<Carried = CarriedBy<M, S, T>>,
    {
        let start = start.into_start(system.description().first_names())?;
        check_step(step)?;
        let prepared = check_start(system, &start)?;
        check_scheme(&scheme, &prepared, &start)?;
        Ok(Self::begin(system, prepared, scheme, start, step))
    }

    /// Makes the run after all checks.
    pub(crate) fn begin<M: Scheme<S, Map<T> = R>>(
        system: &S,
        prepared: S::Prepared<T>,
        scheme: M,
        start: State<VectorOf<S, T>>,
        step: T,
    ) -> Self
    where
        R: Map<Carried = CarriedBy<M, S, T>>,
    {
        let entry = scheme.entry();
        let carried = scheme.start(&prepared, &start, step);
        let map = scheme.prepare(&prepared, Step::of(step));
        Integrator {
            work: Scratch::like(&carried),
            map,
            snapshot: carried.clone(),
            shown: carried.clone(),
            carried,
            clock: Clock::new(start.t, step * duration(&entry)),
            parameters: parameters(system),
            prepared,
            recipe: Arc::new(scheme),
            entry,
            step,
            began: 0,
            steps: 0,
            state: start,
            ended: false,
            memory: Memory::default(),
            refused: None,
            #[cfg(feature = "std")]
            saving: None,
            #[cfg(feature = "rayon")]
            threads: None,
            observer: (),
        }
    }
}
