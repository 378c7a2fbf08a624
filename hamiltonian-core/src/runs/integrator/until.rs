//! Runs to a time, and their states at times.
//!
//! Input: a run and times. Output: the run at or near a time, and states at times. Invariant: only whole steps change
//! the run; a state between two steps is made by a part of a step.

use super::{Integrator, MapOf};
use crate::errors::{Error, TimeError};
use crate::observers::observe::{Between, Observer};
use crate::systems::state::{Carried, State};
use crate::systems::system::{Dynamics, System, VectorOf};
use crate::systems::vector::Vector;
use hamiltonian_lanes::{Mask, Real};

/// The part of the steps to a time, at their present size, that are attempted at once: steps may become eight times as long.
const LIKELY: f64 = 1.0 / 8.0;
/// The largest number of steps attempted at once before a time.
const MOST_LIKELY: u64 = 64;

impl<T: Real, S: System, R: MapOf<T, S>, O: Observer<T, S>> Integrator<T, S, R, O> {
    /// Advances the run to the time `t`, which is a whole number of steps from the current time.
    ///
    /// For any other time, use [`advance_until`](Integrator::advance_until). Times are compared up to the rounding of
    /// `t`, of the step and of the start. The step size does not change.
    ///
    /// ```
    #[doc = include_str!("../../doc/oscillator.md")]
    ///
    /// let start = State::new([1.0], [0.0]);
    /// let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), start, 0.01)?;
    /// run.advance_to(0.3)?;
    /// assert_eq!(run.steps(), 30);
    /// assert!(matches!(run.advance_to(0.305), Err(Error::Time(_))));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`TimeError::OffGrid`] with the reachable times on both sides, [`TimeError::Behind`],
    /// [`TimeError::Unreachable`], [`TimeError::Uneven`] if steps vary in time; no step is then made. Those of
    /// [`advance`](Integrator::advance).
    pub fn advance_to(&mut self, t: T) -> Result<&State<VectorOf<S, T>>, Error> {
        if self.varies() {
            return Err(TimeError::Uneven.into());
        }
        match self.whole_steps(t)? {
            (None, steps) => self.advance(steps),
            (Some(before), after) => {
                let made = self.steps - self.began;
                Err(TimeError::OffGrid {
                    clock: self.prepared.description().clock().into(),
                    target: t.to_f64(),
                    before: self.clock.at(made + before).to_f64(),
                    after: self.clock.at(made + after).to_f64(),
                }
                .into())
            }
        }
    }

    /// Advances the run by the whole steps up to `t`, and returns the state at `t`, which may be any later time.
    ///
    /// The state at `t` is made by one shorter step of a temporary run. [`state`](Integrator::state) remains the one
    /// after the last whole step. Observers receive the states after whole steps only, and an event in the shorter step
    /// is located by the next whole step.
    ///
    /// If steps vary in time, the run makes the step that passes `t` too, since its duration is known only after it. If
    /// an observer ends the run before `t`, the state of that end is returned, see [`has_ended`](Integrator::has_ended).
    ///
    /// ```
    #[doc = include_str!("../../doc/oscillator.md")]
    ///
    /// let start = State::new([1.0], [0.0]);
    /// let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), start, 0.01)?;
    /// let state = run.advance_until(0.305)?;
    /// assert_eq!((state.t, run.time()), (0.305, 0.3));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`TimeError::Behind`], [`TimeError::Unreachable`]; those of
    /// [`advance`](Integrator::advance) and of [`state_at`](Integrator::state_at).
    pub fn advance_until(&mut self, t: T) -> Result<State<VectorOf<S, T>>, Error> {
        if self.varies() {
            return self.past(t);
        }
        let (before, after) = self.whole_steps(t)?;
        self.advance(before.unwrap_or(after))?;
        match before {
            // The end is a step of the grid, or the state at which an observer ended the run.
            _ if self.ended => Ok(self.state.clone()),
            None => Ok(self.state.clone()),
            Some(_) => self.part_in_place().state_at(t),
        }
    }

    /// Advances the run in a loop: returns the states after `every`, 2·`every`, … further steps (0 counts as 1).
    ///
    /// The iterator ends when an observer ends the run; otherwise it is infinite. The first error is the last item.
    ///
    /// ```
    #[doc = include_str!("../../doc/oscillator.md")]
    ///
    /// let start = State::new([1.0], [0.0]);
    /// let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), start, 0.01)?;
    /// for state in run.states(10).take(3) {
    ///     let state = state?;
    ///     println!("{} {}", state.t, state.q[0]);
    /// }
    /// assert_eq!(run.steps(), 30);
    /// # Ok::<(), Error>(())
    /// ```
    pub fn states(&mut self, every: u64) -> States<'_, T, S, R, O> {
        States {
            run: self,
            every: every.max(1),
            failed: false,
        }
    }

    /// Advances the run in a loop: returns the states at the given times, as
    /// [`advance_until`](Integrator::advance_until) does.
    ///
    /// The times are in the order of the run, and need not be multiples of the step. The iterator ends if an observer
    /// ends the run. The first error is the last item.
    ///
    /// ```
    #[doc = include_str!("../../doc/oscillator.md")]
    ///
    /// let start = State::new([1.0], [0.0]);
    /// let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), start, 0.03)?;
    /// for state in run.states_at([0.1, 0.2, 1.0]) {
    ///     let state = state?;
    ///     assert!((state.q[0] - state.t.cos()).abs() < 1e-4);
    /// }
    /// # Ok::<(), Error>(())
    /// ```
    pub fn states_at<I: IntoIterator<Item = T>>(
        &mut self,
        times: I,
    ) -> impl Iterator<Item = Result<State<VectorOf<S, T>>, Error>> {
        let mut times = times.into_iter();
        let mut failed = false;
        core::iter::from_fn(move || {
            if failed || self.ended {
                return None;
            }
            let state = self.advance_until(times.next()?);
            failed = state.is_err();
            Some(state)
        })
    }

    /// Returns true if steps differ in time.
    fn varies(&self) -> bool {
        self.carried.duration(self.clock.interval).is_some()
    }

    /// Makes steps of unknown duration until `t` is passed.
    fn past(&mut self, t: T) -> Result<State<VectorOf<S, T>>, Error> {
        if !t.is_finite() {
            return Err(TimeError::Unreachable {
                clock: self.prepared.description().clock().into(),
                target: t.to_f64(),
            }
            .into());
        }
        let is_forward = T::zero().lt(self.clock.interval).all();
        let begin = (self.state.t, self.steps);
        while !self.ended {
            let (behind, ahead) = match is_forward {
                true => (self.state.t, t),
                false => (t, self.state.t),
            };
            if !behind.lt(ahead).any() {
                return self.part_in_place().state_at(t);
            }
            let left = t - self.state.t;
            let sure = self.carried.steps_within(self.clock.interval, left);
            self.advance(sure)?;
            if sure == 1 && !self.ended {
                self.advance_likely(t, begin);
            }
        }
        Ok(self.state.clone())
    }

    /// Makes several steps that vary in time and will probably end before `t`, if no observer receives a state in between:
    /// at most half of those that remain at the mean size since `from`, where the run stood at this time and had made so
    /// many steps. Where one of them fails, or passes `t`, the run goes back: those are made one by one.
    fn advance_likely(&mut self, t: T, (from, steps): (T, u64)) {
        let made = self.steps - steps;
        let left = t - self.state.t;
        let at_mean_size = T::constant(made as f64, 0.0) * left / (self.state.t - from);
        let at_this_size = match self.carried.duration(self.clock.interval) {
            Some(size) => left / size,
            None => T::zero(),
        };
        // A conversion of NaN is 0.
        let at_mean_size = (at_mean_size * T::constant(0.5, 0.0)).to_f64() as u64;
        let at_this_size = (at_this_size * T::constant(LIKELY, 0.0)).to_f64() as u64;
        let n = at_mean_size.min(at_this_size).min(made).min(MOST_LIKELY);
        let due = self.next_stop().saturating_sub(self.steps + 1);
        let n = n.min(due);
        if n < 2 || T::LANES > 1 {
            return;
        }
        let is_before = |run: &Self| {
            let left = (t - run.state.t) / run.clock.interval;
            T::zero().lt(left).all()
        };
        if self.makes(n) && is_before(self) {
            self.steps += n;
        } else {
            self.carried.copy_from(&self.snapshot);
            self.show_carried();
        }
    }

    /// The number of steps to `t`, as in [`Clock::whole_steps`].
    fn whole_steps(&self, t: T) -> Result<(Option<u64>, u64), TimeError> {
        let clock = self.prepared.description().clock();
        (self.clock).whole_steps(self.steps - self.began, t, clock)
    }
}

impl<T: Real, S: System, R: MapOf<T, S>, O> Integrator<T, S, R, O> {
    /// Returns the state at a time at most one step before or after the current one. The run does not change.
    ///
    /// The state is made by one shorter step of a temporary run. Its error has the order of the scheme.
    ///
    /// Within the last step of [`Gauss`](crate::schemes::Gauss), [`GaussNystrom`](crate::schemes::GaussNystrom) and runs
    /// to a tolerance, the shorter step begins at the nearer end of that step, and its iteration at the collocation
    /// polynomial of that step. It takes about half as many evaluations of J∇H as a step.
    ///
    /// ```
    #[doc = include_str!("../../doc/oscillator.md")]
    ///
    /// let start = State::new([1.0], [0.0]);
    /// let run = Integrator::new(&Oscillator {}, StormerVerlet::default(), start, 0.01)?;
    /// let state = run.state_at(0.004)?;
    /// assert!((state.q[0] - 0.004_f64.cos()).abs() < 1e-8);
    /// assert!(run.state_at(0.02).is_err());
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`TimeError::Far`] for a time further away; [`StepError::NotFinite`](crate::errors::StepError::NotFinite) and
    /// [`StepError::Unsolved`](crate::errors::StepError::Unsolved), in which the
    /// step has the number 1.
    pub fn state_at(&self, t: T) -> Result<State<VectorOf<S, T>>, Error> {
        self.part().state_at(t)
    }
}

/// The iterator of [`Integrator::states`].
pub struct States<'a, T: Real, S: System, R: MapOf<T, S>, O> {
    run: &'a mut Integrator<T, S, R, O>,
    every: u64,
    failed: bool,
}

impl<T: Real, S: System, R: MapOf<T, S>, O: Observer<T, S>> Iterator for States<'_, T, S, R, O> {
    type Item = Result<State<VectorOf<S, T>>, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.failed || self.run.has_ended() {
            return None;
        }
        let state = self.run.advance(self.every).cloned();
        self.failed = state.is_err();
        Some(state)
    }
}
