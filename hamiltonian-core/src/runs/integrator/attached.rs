//! Observers in a run: how they are attached, and how they end it.
//!
//! Input: a run and an observer. Output: the run with it. Invariant: observers change no bit of a run, but may end it.

use super::{Integrator, MapOf};
use crate::errors::Error;
use crate::observers::observe::Observer;
use crate::systems::state::State;
use crate::systems::system::{System, VectorOf};
use hamiltonian_lanes::Real;

impl<T: Real, S: System, R: MapOf<T, S>, O> Integrator<T, S, R, O> {
    /// Returns true if an observer has ended the run. [`advance`](Integrator::advance) then makes no steps and returns
    /// the current state, until [`go_on`](Integrator::go_on) is called.
    pub fn has_ended(&self) -> bool {
        self.ended
    }

    /// Allows further steps of a run that an observer has ended. This makes no step.
    ///
    /// If the run ended between two steps, it continues from the end of the last whole step. After
    /// [`set_state`](Integrator::set_state), [`set_system`](Integrator::set_system) or
    /// [`change_step`](Integrator::change_step) it continues from the state of that change.
    pub fn go_on(&mut self) {
        self.ended = false;
        self.arrives(self.steps);
    }

    /// Passes the current state to a new observer, or restores its saved data.
    pub(super) fn attach<N: Observer<T, S>>(&mut self, observer: &mut N) {
        if self.memory.is_empty() {
            if observer.attach(&self.view(&self.part())).is_break() {
                self.end(observer.end().map(Option::<&_>::cloned));
            }
            return;
        }
        let mut memory = core::mem::take(&mut self.memory);
        let restored = observer.restore(&self.view(&self.part()), &mut memory);
        self.memory = memory;
        match restored {
            Ok(()) if self.ended => self.end(observer.end().map(Option::<&_>::cloned)),
            Ok(()) => {}
            Err(error) => self.refused = Some(error),
        }
    }

    /// Ends the run at a state between two steps, or at the current one.
    pub(super) fn end(&mut self, end: Result<Option<State<VectorOf<S, T>>>, Error>) {
        self.ended = true;
        match end {
            Ok(Some(state)) => self.state = state,
            Ok(None) => {}
            Err(error) => self.refused = Some(error),
        }
    }

    /// Replaces the observer by one that is made from it.
    pub(super) fn with_observer<N>(self, make: impl FnOnce(O) -> N) -> Integrator<T, S, R, N> {
        Integrator {
            prepared: self.prepared,
            recipe: self.recipe,
            entry: self.entry,
            map: self.map,
            work: self.work,
            carried: self.carried,
            snapshot: self.snapshot,
            shown: self.shown,
            clock: self.clock,
            step: self.step,
            began: self.began,
            steps: self.steps,
            state: self.state,
            ended: self.ended,
            memory: self.memory,
            refused: self.refused,
            #[cfg(feature = "std")]
            saving: self.saving,
            parameters: self.parameters,
            #[cfg(feature = "rayon")]
            threads: self.threads,
            observer: make(self.observer),
        }
    }
}
