//! The steps of a run.
//!
//! Input: a run. Output: the run after these steps, or an error that names the first bad step.
//! Invariant: a state that is not finite is never returned; a failed run stands at the last good
//! state.

use super::part::{LastStep, Part};
use super::{Integrator, MapOf, numbers};
use crate::errors::Error;
use crate::flows::map::{Clock, Map, ScalarOf};
use crate::observers::observe::{Observer, View};
use crate::runs::failed::Failed;
use crate::systems::domain;
use crate::systems::state::{Carried, State};
use crate::systems::system::{Dynamics, System, VectorOf};
use crate::systems::vector::Vector;
use hamiltonian_lanes::{Mask, Real};

/// The number of steps between two checks that everything is finite, H included: few enough that a bad block is
/// repeated quickly, enough that the check costs nothing.
const BLOCK: u64 = 1024;

/// The first multiple of `interval` after `steps`.
fn next_multiple(steps: u64, interval: u64) -> u64 {
    (steps / interval)
        .saturating_add(1)
        .saturating_mul(interval)
}

impl<T: Real, S: System, R: MapOf<T, S>, O: Observer<T, S>> Integrator<T, S, R, O> {
    /// Makes `n` steps and returns the state after them. If an observer ends the run, there are fewer steps.
    ///
    /// # Errors
    /// - [`StepError::NotFinite`](crate::errors::StepError::NotFinite) if a state or its H is not finite, and
    ///   [`StepError::Unsolved`](crate::errors::StepError::Unsolved) if an implicit step was not solved; of an
    ///   adaptive scheme [`StepError::Refused`](crate::errors::StepError::Refused) and
    ///   [`StepError::Jumped`](crate::errors::StepError::Jumped). The run is then at the state before that step. To
    ///   continue, [change the step](Integrator::change_step) and advance again.
    /// - The error of an observer that cannot continue. Later calls return it again.
    /// - [`CheckpointError::File`](crate::errors::CheckpointError::File) if
    ///   [`with_checkpoints`](Integrator::with_checkpoints) cannot write its file. The run has made the step and can
    ///   continue.
    /// - [`CheckpointError::Other`](crate::errors::CheckpointError::Other) and
    ///   [`CheckpointError::Damaged`](crate::errors::CheckpointError::Damaged) for a resumed run whose observers are not
    ///   those that were saved.
    pub fn advance(&mut self, n: u64) -> Result<&State<VectorOf<S, T>>, Error> {
        if let Some(error) = &self.refused {
            return Err(error.clone());
        }
        self.memory.refuse_rest()?;
        let end = self.steps.saturating_add(n);
        while self.steps < end && !self.ended {
            let due = self.next_observation();
            self.run_to(due.min(end).min(self.next_save()))?;
            if self.steps == due {
                let part = Part {
                    prepared: &self.prepared,
                    recipe: &*self.recipe,
                    state: &self.state,
                    step: self.step,
                    clock: self.clock,
                    duration: self.carried.duration(self.clock.interval),
                    last: LastStep::of(
                        &self.map,
                        &self.carried,
                        Some(&mut self.work),
                        self.clock,
                        due - self.began,
                        self.state.t,
                    ),
                };
                let view = View {
                    steps: self.steps,
                    state: &self.state,
                    prepared: &self.prepared,
                    between: &part,
                };
                if self.observer.observe(&view).is_break() {
                    let end = self.observer.end().map(Option::<&_>::cloned);
                    self.end(end);
                    if let Some(error) = &self.refused {
                        return Err(error.clone());
                    }
                }
            }
            self.save_if_due()?;
        }
        Ok(&self.state)
    }

    /// The number of the step after which the observer receives the next state.
    fn next_observation(&self) -> u64 {
        next_multiple(self.steps, self.observer.interval().max(1))
    }

    /// The number of the step after which the run is observed or saved next.
    pub(super) fn next_stop(&self) -> u64 {
        self.next_observation().min(self.next_save())
    }

    /// The number of the step after which the run is saved next.
    fn next_save(&self) -> u64 {
        #[cfg(feature = "std")]
        if let Some((every, _)) = &self.saving {
            return next_multiple(self.steps, *every);
        }
        u64::MAX
    }

    /// Saves the run if this step is one at which it is saved.
    fn save_if_due(&self) -> Result<(), Error> {
        #[cfg(feature = "std")]
        if let Some((every, path)) = &self.saving
            && self.steps.is_multiple_of(*every)
        {
            self.checkpoint().save(path)?;
        }
        Ok(())
    }

    /// Makes steps to `stop` and leaves the synchronised state there.
    fn run_to(&mut self, stop: u64) -> Result<(), Error> {
        while self.steps < stop {
            let n = BLOCK.min(stop - self.steps);
            if !self.makes(n) {
                return Err(self.replay(n));
            }
            self.steps += n;
        }
        Ok(())
    }

    /// Makes `n` steps from a snapshot. Returns true if everything is finite after them, H included.
    pub(super) fn makes(&mut self, n: u64) -> bool {
        self.makes_numbers(n) && domain::is_inside::<T, S>(&self.prepared, &self.state)
    }

    /// Makes `n` steps from a snapshot. Returns true if all numbers are finite after them.
    fn makes_numbers(&mut self, n: u64) -> bool {
        let steps = Steps {
            map: &self.map,
            work: &mut self.work,
            carried: &mut self.carried,
            snapshot: &mut self.snapshot,
            shown: &mut self.shown,
            state: &mut self.state,
            clock: self.clock,
            made: self.steps - self.began,
            n,
        };
        #[cfg(feature = "rayon")]
        if let Some(threads) = &self.threads {
            return threads.make(steps);
        }
        steps.make()
    }

    /// Repeats the block of `n` steps one by one, and stops before the bad one.
    #[cold]
    fn replay(&mut self, n: u64) -> Error {
        let last = self.steps + n - 1;
        self.carried.copy_from(&self.snapshot);
        loop {
            let good = self.makes(1);
            // If no earlier step was bad, the last one is.
            if good && self.steps < last {
                self.steps += 1;
                continue;
            }
            let bad = !(self.carried.finite() & self.shown.finite());
            let undefined = match bad.any() {
                true => None,
                false => domain::undefined::<T, S>(&self.prepared, &self.state),
            };
            let bad = bad.first().or(undefined.map(|(lane, _)| lane));
            let lane = (T::LANES > 1).then(|| bad.unwrap_or(0));
            let made = self.steps - self.began;
            let (begin, end) = (self.clock.at(made), self.clock.at(made + 1));
            self.carried.copy_from(&self.snapshot);
            let cause = self
                .map
                .explain(begin, end, made == 0, &mut self.carried, &mut self.work);
            let failed = Failed {
                step: self.steps + 1,
                lane,
                clock: self.prepared.description().clock().into(),
                begin: self.snapshot.time(begin).to_f64(),
                end: self.state.t.to_f64(),
                q: numbers(&self.state.q),
                p: numbers(&self.state.p),
                energy: undefined.map(|(_, energy)| energy),
            };
            let error = failed.because(cause);
            self.carried.copy_from(&self.snapshot);
            self.arrives(self.steps);
            return error.into();
        }
    }
}

impl<T: Real, S: System, R: MapOf<T, S>, O> Integrator<T, S, R, O> {
    /// Writes the state after the `made` steps of the map. Returns true if everything is finite.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn arrives(&mut self, steps: u64) -> bool {
        let made = steps - self.began;
        let steps = Steps {
            map: &self.map,
            work: &mut self.work,
            carried: &mut self.carried,
            snapshot: &mut self.snapshot,
            shown: &mut self.shown,
            state: &mut self.state,
            clock: self.clock,
            made,
            n: 0,
        };
        steps.arrive()
    }

    /// Writes the state again after a change of the carried value.
    pub(crate) fn show_carried(&mut self) {
        self.arrives(self.steps);
    }
}

/// The data of steps.
pub(crate) struct Steps<'a, R: Map> {
    map: &'a R,
    work: &'a mut R::Work,
    carried: &'a mut R::Carried,
    snapshot: &'a mut R::Carried,
    shown: &'a mut R::Carried,
    state: &'a mut State<<R::Carried as Carried>::Vector>,
    clock: Clock<ScalarOf<R>>,
    /// The number of steps made since the clock began.
    made: u64,
    /// The number of steps to be made.
    n: u64,
}

impl<R: Map> Steps<'_, R> {
    /// Makes the steps. Returns true if everything is finite after them. The loop over steps is
    /// compiled here only.
    #[inline(never)]
    pub(crate) fn make(self) -> bool {
        // This runs in a function of the level of a pack: here its instructions would be calls.
        ScalarOf::<R>::out_of_line(
            #[cfg_attr(not(unoptimised), inline(always))]
            || {
                self.snapshot.copy_from(self.carried);
                (self.map).run(self.clock, self.made, self.n, self.carried, self.work);
                self.arrive()
            },
        )
    }

    /// Writes the state after the steps. Returns true if everything is finite.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn arrive(self) -> bool {
        let made = self.made + self.n;
        let t = self.clock.at(made);
        self.shown.copy_from(self.carried);
        if made > 0 {
            self.map.close(t, self.shown, self.work);
        }
        let point = self.shown.point();
        self.state.q.copy_from(&point.q);
        self.state.p.copy_from(&point.p);
        self.state.t = self.shown.time(t);
        self.state.t.is_finite() && self.shown.is_finite() && self.carried.is_finite()
    }
}
