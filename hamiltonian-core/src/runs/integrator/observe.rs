//! Observers of a run.
//!
//! Input: a run and an observer. Output: the run with it. Invariant: observers change no bit of a run, but may end it.

use super::{Integrator, MapOf};
use crate::errors::Error;
use crate::observers::observe::{self, Every, Observer, Unobserved, Verdict, View, Watch};
use crate::systems::state::State;
use crate::systems::system::{System, VectorOf};
use hamiltonian_lanes::Real;

impl<T: Real, S: System, R: MapOf<T, S>, O> Integrator<T, S, R, O> {
    /// Attaches an observer. It receives the current state at once, and then every state whose step number is a multiple
    /// of its [interval](Observer::interval), whichever method makes the steps.
    ///
    /// Call it once. To attach several observers, pass a tuple, `.observe((EnergyDrift::new(), Recorder::new()))`.
    /// [`watch`](Integrator::watch) comes after it. The run owns the observer, and
    /// [`observer`](Integrator::observer) returns a reference to it; `&mut O` is an observer too.
    pub fn observe<N: Observer<T, S>>(mut self, mut observer: N) -> Integrator<T, S, R, N>
    where
        O: Unobserved,
    {
        self.attach(&mut observer);
        self.with_observer(|_| observer)
    }
}

impl<T: Real, S: System, R: MapOf<T, S>, O: Observer<T, S>> Integrator<T, S, R, O> {
    /// Attaches a closure. It receives the current state at once, and then every state whose step number is a multiple of
    /// `every` (0 counts as 1).
    ///
    /// The closure returns `()`, or a [`ControlFlow<()>`](core::ops::ControlFlow) whose `Break` ends the run. Call
    /// `watch` any number of times, with or without an observer: [`observer`](Integrator::observer) is then the pair of
    /// the previous observer and the closure.
    ///
    /// ```
    #[doc = include_str!("../../doc/oscillator.md")]
    ///
    /// let mut path = Vec::new();
    /// let start = State::new([1.0], [0.0]);
    /// let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), start, 0.01)?
    ///     .observe(EnergyDrift::new())
    ///     .watch(10, |view| path.push((view.state.q[0], view.state.p[0])));
    /// run.advance(100)?;
    /// assert!(run.observer().0.max_relative() < 1e-4);
    /// assert_eq!(path.len(), 11);
    /// # Ok::<(), Error>(())
    /// ```
    pub fn watch<V: Verdict, F: FnMut(&View<'_, T, S>) -> V>(
        mut self,
        every: u64,
        closure: F,
    ) -> Integrator<T, S, R, (O, Every<Watch<F>>)> {
        let mut closure = observe::every(every, observe::watch(closure));
        self.attach(&mut closure);
        self.with_observer(|observer| (observer, closure))
    }
}

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
    fn attach<N: Observer<T, S>>(&mut self, observer: &mut N) {
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
    fn with_observer<N>(self, make: impl FnOnce(O) -> N) -> Integrator<T, S, R, N> {
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
