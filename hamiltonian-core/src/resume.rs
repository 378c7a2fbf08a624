//! Saving a run and going on with it.
//!
//! Input: a run, or a [`Checkpoint`]. Output: the other. Invariant: a checkpoint of another system,
//! of other parameters or of another scheme is refused.

use crate::checkpoint::{Checkpoint, Memory};
use crate::error::{CheckpointError, Error};
use crate::integrator::{Integrator, MapOf, SystemText};
use crate::map::Clock;
use crate::observe::Observer;
use crate::part::Recipe;
use crate::scheme::Scheme;
use crate::state::State;
use crate::system::System;
use crate::vector::Vector;
use alloc::borrow::ToOwned;
use hamiltonian_lanes::Real;

impl<T: Real, S: System<T>, R: MapOf<T, S>, O: Observer<T, S>> Integrator<T, S, R, O> {
    /// The run and the memory of its observers, to be saved. Closures remember nothing.
    pub fn checkpoint(&self) -> Checkpoint {
        let mut numbers = Memory::default();
        for scalar in [self.clock.start, self.step] {
            numbers.scalar(scalar);
        }
        for component in self.carried.components() {
            numbers.scalar(component);
        }
        let mut observers = Memory::default();
        self.observer.save(&mut observers);
        Checkpoint {
            system: self.system.formula.clone(),
            parameters: self.system.parameters.clone(),
            scheme: self.recipe.describe(),
            scalar: core::any::type_name::<T>().to_owned(),
            counts: [self.steps, self.began, u64::from(self.ended)],
            numbers,
            observers,
        }
    }
}

impl<S: System<f64>, R: MapOf<f64, S>> Integrator<f64, S, R> {
    /// The run that was saved: it goes on with the same bits, in another process too (of the same
    /// binary, on the same kind of processor). Its observers are attached again in the same order,
    /// by [`observe`](Integrator::observe) and [`watch`](Integrator::watch), and remember what they
    /// saw; with another observer in a place [`advance`](Integrator::advance) returns an error.
    ///
    /// Over another scalar than `f64` it is [`resume_over`](Integrator::resume_over): neither a system
    /// nor a file tells rustc which one.
    ///
    /// ```
    #[doc = include_str!("doc/oscillator.md")]
    /// use hamiltonian_core::{Checkpoint, Integrator, State, schemes::StormerVerlet};
    ///
    /// let scheme = StormerVerlet::default();
    /// let mut run = Integrator::new(&Oscillator, scheme, State::new([1.0], [0.0]), 0.01)?;
    /// let saved = run.checkpoint();
    /// run.advance(10)?;
    /// let mut again = Integrator::resume(&Oscillator, scheme, saved)?;
    /// assert_eq!(again.advance(10)?, run.state());
    /// # Ok::<(), hamiltonian_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`CheckpointError::Other`] for another system, another parameter, scheme or scalar;
    /// [`CheckpointError::Damaged`] for numbers that do not fit.
    pub fn resume<M: Scheme<f64, S, Map = R>>(
        system: &S,
        scheme: M,
        checkpoint: Checkpoint,
    ) -> Result<Self, Error> {
        Self::resume_over(system, scheme, checkpoint)
    }
}

impl<T: Real, S: System<T>, R: MapOf<T, S>> Integrator<T, S, R> {
    /// The run over another scalar that was saved: `Integrator::<DoubleDouble, _, _>::resume_over(…)`. All
    /// else is as with [`resume`](Integrator::resume).
    ///
    /// # Errors
    /// Those of [`resume`](Integrator::resume).
    pub fn resume_over<M: Scheme<T, S, Map = R>>(
        system: &S,
        scheme: M,
        checkpoint: Checkpoint,
    ) -> Result<Self, Error> {
        let zeros = system.zeros();
        let given = SystemText::of(system, &zeros);
        Checkpoint::same("system", &checkpoint.system, &given.formula)?;
        Checkpoint::same("parameter", &checkpoint.parameters, &given.parameters)?;
        let described = Recipe::<T, S, R>::describe(&scheme);
        Checkpoint::same("scheme", &checkpoint.scheme, &described)?;
        let scalar = core::any::type_name::<T>();
        Checkpoint::same("scalar", &checkpoint.scalar, scalar)?;

        let mut numbers = checkpoint.numbers;
        let start: T = numbers.read_scalar()?;
        let step = numbers.read_scalar()?;
        let template = State {
            t: start,
            q: zeros.clone(),
            p: zeros,
        };
        let mut run = Integrator::begin(system, system.prepare(), scheme, template, step);
        for index in 0..run.carried.len() {
            *run.carried.component_mut(index) = numbers.read_scalar()?;
        }
        let [steps, began, ended] = checkpoint.counts;
        if !numbers.is_empty() || began > steps {
            return Err(CheckpointError::Damaged {
                reason: "the numbers do not fit",
            }
            .into());
        }
        let clock = Clock {
            start,
            interval: run.clock.interval,
        };
        run.restore(clock, began, steps);
        run.ended = ended != 0;
        run.memory = checkpoint.observers;
        Ok(run)
    }
}
