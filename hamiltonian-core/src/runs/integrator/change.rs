//! Changes of a run between two steps.
//!
//! Input: a run, and another step, state or system. Output: the run, which goes on from there. Invariants: the number of
//! steps, the observers and the times of steps stay; a change that is refused leaves the run as it was.

use super::checks::{check_change, check_values, onto_shell};
use super::part::{LastStep, Part};
use super::{Integrator, MapOf, check_step, duration};
use crate::errors::Error;
use crate::flows::map::{Clock, Step};
use crate::observers::observe::Observer;
use crate::systems::state::{Carried, IntoStart, State};
use crate::systems::system::{Dynamics, ParameterText, System, VectorOf};
use hamiltonian_lanes::{Mask, Real};

impl<T: Real, S: System, R: MapOf<T, S>, O: Observer<T, S>> Integrator<T, S, R, O> {
    /// Replaces the state between two steps, for example by a kick or a thermostat. The scheme, the step size, the number
    /// of steps, the times and the observers stay.
    ///
    /// The new state has the time of the run: change a clone of [`state`](Integrator::state), or write
    /// `State::new(q, p).at(run.time())`.
    ///
    /// The scheme starts anew at the state. Observers receive the change by [`Observer::change`]:
    /// [`EnergyDrift`](crate::observers::EnergyDrift) does not count it as a drift, and
    /// [`Events`](crate::observers::Events) locate no event in it. If an observer has ended the run,
    /// [`go_on`](Integrator::go_on) allows further steps, from the new state.
    ///
    /// In a time-transformed system (`dt = g*ds`), the momentum of time becomes p_t = −h of the new state, whatever the
    /// state has: orbits are those of h on the shell H = 0 alone.
    ///
    /// ```
    #[doc = include_str!("../../doc/oscillator.md")]
    ///
    /// let start = State::new([1.0], [0.0]);
    /// let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), start, 0.01)?
    ///     .observe(EnergyDrift::new());
    /// for _ in 0..10 {
    ///     run.advance(100)?;
    ///     let mut state = run.state().clone();
    ///     state.p[0] += 0.5; // a kick
    ///     run.set_state(state)?;
    /// }
    /// assert_eq!(run.steps(), 1_000);
    /// assert!(run.observer().drift().is_some_and(|drift| drift.max_absolute() < 1e-4));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`StartError::OtherTime`](crate::errors::StartError::OtherTime) if the state has another time than the run;
    /// [`InputError::Shape`](crate::errors::InputError::Shape),
    /// [`StartError::NotFinite`](crate::errors::StartError::NotFinite),
    /// [`StartError::Values`](crate::errors::StartError::Values) and those of [`Scheme::check`](crate::Scheme::check) as
    /// for a [new](Integrator::new) run; the error of an observer that cannot continue. The run then is as before.
    pub fn set_state(&mut self, state: impl IntoStart<VectorOf<S, T>>) -> Result<(), Error> {
        let mut state = state.into_start(self.prepared.description().first_names())?;
        check_change::<T, S>(&self.prepared, &self.state, &mut state)?;
        self.go_on_from(self.prepared.clone(), self.parameters.clone(), state)
    }

    /// Replaces the system between two steps by one with other parameters, for example for a slider or the elements of a
    /// ring. The state, the scheme, the step size, the number of steps, the times and the observers stay, and
    /// observers receive the change as that of a [state](Integrator::set_state). In a time-transformed system, the
    /// momentum of time becomes −h of the new system.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    ///
    /// hamiltonian! {
    ///     /// A spring.
    ///     pub struct Spring { k = 1.0 }
    ///     H(q; p) = p^2/2 + k*q^2/2
    /// }
    ///
    /// let spring = Spring::default();
    /// let mut run = Integrator::new(&spring, StormerVerlet::default(), State::new([1.0], [0.0]), 0.01)?;
    /// run.advance(100)?;
    /// run.set_system(&Spring { k: 2.0 })?;
    /// run.advance(100)?;
    /// assert_eq!(run.steps(), 200);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`InputError::Shape`](crate::errors::InputError::Shape) for a system of other sizes;
    /// [`StartError::Values`](crate::errors::StartError::Values) and those of [`Scheme::check`](crate::Scheme::check) as
    /// for a [new](Integrator::new) run; the error of an observer that cannot continue. The run then is as before.
    pub fn set_system(&mut self, system: &S) -> Result<(), Error> {
        system.check_shape(&self.state)?;
        let mut prepared = system.prepare();
        let mut state = self.state.clone();
        onto_shell::<T, S>(&prepared, &mut state);
        check_values::<T, S>(&prepared, &state, || ParameterText::of_now(system))?;
        prepared.set_arithmetic(self.prepared.arithmetic());
        self.go_on_from(prepared, system.parameter_text(), state)
    }
}

impl<T: Real, S: System, R: MapOf<T, S>, O> Integrator<T, S, R, O> {
    /// Replaces the step size. The scheme starts anew at the current state.
    ///
    /// The times of steps are then multiples of the new step from the current time, also for
    /// [`advance_to`](Integrator::advance_to). Observers are not informed. Frequent changes destroy the long-term
    /// behaviour of symplectic and reversible schemes: for steps of varying length, use
    /// [`Paced`](crate::schemes::Paced).
    ///
    /// ```
    #[doc = include_str!("../../doc/oscillator.md")]
    ///
    /// let start = State::new([1.0], [0.0]);
    /// let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), start, 0.01)?;
    /// run.advance(100)?;
    /// run.change_step(0.001)?;
    /// run.advance_to(1.005)?;
    /// assert_eq!(run.steps(), 105);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`StartError::Step`](crate::errors::StartError::Step) for a zero, NaN or infinite step.
    pub fn change_step(&mut self, step: T) -> Result<(), Error> {
        check_step(step)?;
        self.carried = self.recipe.start(&self.prepared, &self.state, step);
        self.map = self.recipe.prepare(&self.prepared, Step::of(step));
        self.clock = Clock::new(self.state.t, step * duration(&self.entry));
        self.step = step;
        self.began = self.steps;
        // The second copy that can be observed is the one of the new start.
        self.arrives(self.steps);
        Ok(())
    }
}

impl<T: Real, S: System, R: MapOf<T, S>, O: Observer<T, S>> Integrator<T, S, R, O> {
    /// Goes on with this system from this state, which has the time of the run.
    fn go_on_from(
        &mut self,
        prepared: S::Prepared<T>,
        parameters: ParameterText,
        state: State<VectorOf<S, T>>,
    ) -> Result<(), Error> {
        if let Some(error) = &self.refused {
            return Err(error.clone());
        }
        self.memory.refuse_rest()?;
        self.recipe.check(&prepared, &state)?;
        let carried = self.recipe.start(&prepared, &state, self.step);
        // At the end of a step the times stay those of the run. An observer may have ended it between two steps.
        let made = self.steps - self.began;
        let now = self.clock.at(made);
        let is_end_of_step = self.shown.time(now).equals(state.t).all();
        let clock = match is_end_of_step {
            true => Clock {
                first: self.clock.first + T::constant(made as f64, 0.0),
                ..self.clock
            },
            false => Clock::new(state.t, self.clock.interval),
        };
        let after = Part {
            prepared: &prepared,
            recipe: &*self.recipe,
            state: &state,
            step: self.step,
            clock,
            duration: carried.duration(clock.interval),
            last: None,
        };
        let before = Part {
            prepared: &self.prepared,
            recipe: &*self.recipe,
            state: &self.state,
            step: self.step,
            clock: self.clock,
            duration: self.carried.duration(self.clock.interval),
            last: LastStep::of(
                &self.map,
                &self.carried,
                None,
                self.clock,
                made,
                self.state.t,
            ),
        };
        let [from, to] = [&before, &after].map(|part| part.view(self.steps));
        self.observer.change(&from, &to);
        self.map = self.recipe.prepare(&prepared, Step::of(self.step));
        self.carried = carried;
        self.prepared = prepared;
        self.parameters = parameters;
        self.clock = clock;
        self.began = self.steps;
        self.arrives(self.steps);
        Ok(())
    }
}
