//! Properties of a run.
//!
//! Input: a run. Output: its state, clock, energy, second copy and observer. Invariant: nothing here
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

    /// The current time.
    pub fn time(&self) -> T {
        self.state.t
    }

    /// The number of steps made.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// The step size.
    pub fn step(&self) -> T {
        self.step
    }

    /// The time that one step advances: the step size, or twice the step size for
    /// [`ConsecutiveSubTrajectories`](crate::schemes::ConsecutiveSubTrajectories).
    pub fn duration(&self) -> T {
        self.clock.interval
    }

    /// The declared H at the current state: in another time, `dt = g*ds`, without g and the
    /// momentum of time.
    pub fn energy(&self) -> T {
        declared_energy::<T, S>(&self.prepared, &self.state)
    }

    /// The observable of that name, a monitor, an invariant or an event, at the current state;
    /// `None` if there is none.
    pub fn observable_named(&self, name: &str) -> Option<T> {
        let index = self.prepared.description().observable_index(name)?;
        let State { t, q, p } = &self.state;
        Some(self.prepared.observable(index, *t, q, p))
    }

    /// The prepared system.
    pub fn prepared(&self) -> &S::Prepared<T> {
        &self.prepared
    }

    /// The scheme's entry in the catalogue.
    pub fn entry(&self) -> Entry {
        self.entry
    }

    /// The value that the scheme carries, before the closing piece of the last step.
    pub fn carried(&self) -> &R::Carried {
        &self.carried
    }

    /// The observer.
    pub fn observer(&self) -> &O {
        &self.observer
    }

    /// Ends the run and returns the observer.
    pub fn into_observer(self) -> O {
        self.observer
    }
}
impl<T: Real, S: System, R, O> Integrator<T, S, R, O>
where
    R: MapOf<T, S> + Map<Carried = Copies<VectorOf<S, T>>>,
{
    /// The second copy (q̃, p̃) at the current time, or the second point of a scheme that carries
    /// two; the first is [`state`](Integrator::state).
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
