//! Properties of a run.
//!
//! Input: a run. Output: its state, clock, energy, observer and second copy. Invariant: nothing here
//! changes a run.

use super::{Integrator, MapOf};
use crate::flows::map::Map;
use crate::schemes::inside::Copies;
use crate::schemes::scheme::Entry;
use crate::systems::state::{Point, State};
use crate::systems::system::{Dynamics, System, VectorOf, declared_energy};
use crate::systems::vector::Vector;
use hamiltonian_lanes::Real;

impl<T: Real, S: System, R: MapOf<T, S>, O> Integrator<T, S, R, O> {
    /// The current state: time, coordinates and momenta, all at the same time.
    pub fn state(&self) -> &State<VectorOf<S, T>> {
        &self.state
    }

    /// The current time: `state().t`. In a time-transformed system (`dt = g*ds`,
    /// [`TimeTransformed`](crate::TimeTransformed)) it is s, and the physical time t is the last coordinate.
    pub fn time(&self) -> T {
        self.state.t
    }

    /// The number of steps made.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// The step size Δt, negative for a backward run. To make one step, call [`advance(1)`](Integrator::advance).
    pub fn step(&self) -> T {
        self.step
    }

    /// The duration of one step: the step size, or twice the step size for
    /// [`ConsecutiveSubTrajectories`](crate::schemes::ConsecutiveSubTrajectories).
    pub fn duration(&self) -> T {
        self.clock.interval
    }

    /// H at the current state. For a time-transformed system (`dt = g*ds`), it is the declared h, not g·(h + p_t).
    pub fn energy(&self) -> T {
        declared_energy::<T, S>(&self.prepared, &self.state)
    }

    /// The observable of that name (a monitor, an invariant or an event) at the current state; `None` if there is none.
    pub fn observable_named(&self, name: &str) -> Option<T> {
        let index = self.prepared.description().observable_index(name)?;
        let State { t, q, p } = &self.state;
        Some(self.prepared.observable(index, *t, q, p))
    }

    /// The attached observer; `()` if there is none.
    pub fn observer(&self) -> &O {
        &self.observer
    }

    /// Consumes the run and returns the attached observer.
    pub fn into_observer(self) -> O {
        self.observer
    }

    /// The system with all that depends on parameters alone computed: H, its derivatives and its observables at any
    /// (t, q, p), see [`Dynamics`].
    pub fn prepared(&self) -> &S::Prepared<T> {
        &self.prepared
    }

    /// The facts about the scheme: its name, order, requirements and source.
    pub fn entry(&self) -> Entry {
        self.entry
    }

    /// The value that the scheme carries from step to step. It is not the state: the closing piece of the last step is
    /// not yet applied to it, see [`Map`].
    pub fn carried(&self) -> &R::Carried {
        &self.carried
    }
}

impl<T: Real, S: System, R, O> Integrator<T, S, R, O>
where
    R: MapOf<T, S> + Map<Carried = Copies<VectorOf<S, T>>>,
{
    /// The second copy (q̃, p̃) at the current time, for example of [`Pihajoki`](crate::schemes::Pihajoki) and
    /// [`Tao`](crate::schemes::Tao), or the second point, for example of
    /// [`TwoStepMidpoint`](crate::schemes::TwoStepMidpoint). The first is [`state`](Integrator::state).
    pub fn copy(&self) -> Point<VectorOf<S, T>> {
        self.shown.y.clone()
    }

    /// The distance of the two copies: the Euclidean norm of (q − q̃, p − p̃).
    pub fn copy_distance(&self) -> f64 {
        let mut sum = T::zero();
        for (a, b) in self.shown.x.components().zip(self.shown.y.components()) {
            sum = (a - b).fma(a - b, sum);
        }
        Real::sqrt(sum.to_f64())
    }
}
