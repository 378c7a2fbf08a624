//! Parts of a step: the state of a run between its steps.
//!
//! Input: the current state of a run and a time. Output: the state at that time, by one step of
//! another size of a copy, of the scheme's own order. Invariant: no bit of the run changes.

use super::{Integrator, MapOf, check_scheme, numbers};
use crate::errors::{Error, StepError, TimeError};
use crate::flows::map::{Clock, Map, Step};
use crate::observers::observe::{Between, Observer, View};
use crate::runs::failed::Failed;
use crate::schemes::scheme::Scheme;
use crate::systems::domain;
use crate::systems::flow::Scratch;
use crate::systems::state::{Carried, State};
use crate::systems::system::{Dynamics, System, VectorOf};
use crate::systems::vector::Vector;
use alloc::format;
use alloc::string::String;
use hamiltonian_lanes::{Mask, Real};

/// The scheme of a run without its type, which makes maps. (The type of a run contains only the
/// map: with the scheme in it, rustc would report a wrong pairing at every call.)
pub(crate) trait Recipe<T: Real, S: System, R: Map>: Send + Sync {
    fn prepare(&self, prepared: &S::Prepared<T>, step: Step<T>) -> R;
    fn start(&self, prepared: &S::Prepared<T>, state: &State<VectorOf<S, T>>, h: T) -> R::Carried;
    fn start_alone(
        &self,
        prepared: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        h: T,
    ) -> R::Carried;
    /// Returns an error if the scheme cannot integrate this system from this state.
    fn check(&self, prepared: &S::Prepared<T>, state: &State<VectorOf<S, T>>) -> Result<(), Error>;
    /// The scheme with all its choices.
    fn describe(&self) -> String;
}

impl<T: Real, S: System, M: Scheme<S>> Recipe<T, S, M::Map<T>> for M {
    fn prepare(&self, prepared: &S::Prepared<T>, step: Step<T>) -> M::Map<T> {
        Scheme::prepare(self, prepared, step)
    }
    fn start(
        &self,
        prepared: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        h: T,
    ) -> <M::Map<T> as Map>::Carried {
        Scheme::start(self, prepared, state, h)
    }
    fn start_alone(
        &self,
        prepared: &S::Prepared<T>,
        state: &State<VectorOf<S, T>>,
        h: T,
    ) -> <M::Map<T> as Map>::Carried {
        Scheme::start_alone(self, prepared, state, h)
    }
    fn check(&self, prepared: &S::Prepared<T>, state: &State<VectorOf<S, T>>) -> Result<(), Error> {
        check_scheme(self, prepared, state)
    }
    fn describe(&self) -> String {
        // A saved run of another scheme is refused with the first line that differs.
        format!("{}\n{self:?}", self.entry())
    }
}

/// Ingredients of a part of a step.
pub(crate) struct Part<'a, T: Real, S: System, R> {
    pub(crate) prepared: &'a S::Prepared<T>,
    pub(crate) recipe: &'a dyn Recipe<T, S, R>,
    pub(crate) state: &'a State<VectorOf<S, T>>,
    pub(crate) step: T,
    pub(crate) clock: Clock<T>,
    /// The approximate length of the next step, if it is not the interval of the clock.
    pub(crate) duration: Option<T>,
}

impl<T: Real, S: System, R: MapOf<T, S>> Between<VectorOf<S, T>> for Part<'_, T, S, R> {
    fn state_at(&self, t: T) -> Result<State<VectorOf<S, T>>, Error> {
        let now = self.state.t;
        // If durations are carried, the previous and the next step have other lengths.
        let (step, most) = match self.duration {
            Some(duration) => (duration, 2.0),
            None => (self.clock.interval, 1.0),
        };
        // This is false for NaN.
        let is_near = ((t - now) / step).magnitude() <= most + self.rounding(now, t);
        if !is_near {
            return Err(TimeError::Far {
                clock: self.prepared.description().clock().into(),
                target: t.to_f64(),
                from: (now - step).to_f64(),
                to: (now + step).to_f64(),
            }
            .into());
        }
        self.at(self.state, t, (t - now) / self.clock.interval)
    }

    fn part(&self, from: &State<VectorOf<S, T>>, time: T) -> Result<State<VectorOf<S, T>>, Error> {
        self.at(from, from.t + time, time / self.clock.interval)
    }

    fn between(&self, from: T, to: T) -> T {
        let time = to - from;
        let is_step = (time - self.clock.interval).magnitude()
            <= self.rounding(from, to) * self.clock.interval.magnitude();
        if is_step { self.clock.interval } else { time }
    }

    fn interval(&self) -> T {
        self.clock.interval
    }

    fn start(&self) -> T {
        self.clock.at(0)
    }
}

impl<T: Real, S: System, R: MapOf<T, S>> Part<'_, T, S, R> {
    /// The state after so many steps, as observers receive it.
    pub(crate) fn view(&self, step: u64) -> View<'_, T, S> {
        View {
            steps: step,
            state: self.state,
            prepared: self.prepared,
            between: self,
        }
    }

    /// The rounding of two times in units of the interval: they are sums and products.
    fn rounding(&self, a: T, b: T) -> f64 {
        4.0 * T::epsilon() * (a.magnitude() + b.magnitude()) / self.clock.interval.magnitude()
    }

    /// The state at `t` by a step of a copy that starts at `from`: by that `part` of the step, or, for a
    /// scheme that carries the time, by the step that leads to `t`.
    fn at(
        &self,
        from: &State<VectorOf<S, T>>,
        t: T,
        mut part: T,
    ) -> Result<State<VectorOf<S, T>>, Error> {
        /// The time is nearly proportional to the step.
        const MAX_ITERATIONS: u32 = 60;
        if part.equals(T::zero()).all() {
            return Ok(from.clone());
        }
        let rounding = self.rounding(from.t, t) * self.clock.interval.magnitude();
        let mut missed = 0.0;
        for _ in 0..MAX_ITERATIONS {
            let h = part * self.step;
            let mut carried = self.recipe.start_alone(self.prepared, from, h);
            let map = self.recipe.prepare(self.prepared, Step::of(h));
            let mut work = Scratch::like(&carried);
            map.step(from.t, t, &mut carried, &mut work);
            let reached = carried.time(t);
            if !(carried.is_finite() && reached.is_finite()) {
                return Err(self.explain(&map, from, h, t, &carried).into());
            }
            missed = (reached - t).magnitude();
            if missed <= rounding {
                let point = carried.point();
                let state = State {
                    t: reached,
                    q: point.q.clone(),
                    p: point.p.clone(),
                };
                if !domain::is_inside::<T, S>(self.prepared, &state) {
                    return Err(self.explain(&map, from, h, t, &carried).into());
                }
                return Ok(state);
            }
            part *= (t - from.t) / (reached - from.t);
        }
        Err(StepError::Unsolved {
            step: 1,
            lane: None,
            clock: self.prepared.description().clock().into(),
            time: from.t.to_f64(),
            residual: missed,
            iterations: MAX_ITERATIONS,
        }
        .into())
    }

    /// The error of the step of size `h` from `from` that led to `carried`.
    #[cold]
    fn explain(
        &self,
        map: &R,
        from: &State<VectorOf<S, T>>,
        h: T,
        t: T,
        carried: &R::Carried,
    ) -> StepError {
        let mut repeated = self.recipe.start_alone(self.prepared, from, h);
        let mut work = Scratch::like(&repeated);
        let cause = map.explain(from.t, t, true, &mut repeated, &mut work);
        let bad = !carried.finite();
        let point = carried.point();
        let undefined = match bad.any() {
            true => None,
            false => {
                let (t, q, p) = (carried.time(t), point.q.clone(), point.p.clone());
                domain::undefined::<T, S>(self.prepared, &State { t, q, p })
            }
        };
        let bad = bad.first().or(undefined.map(|(lane, _)| lane));
        let failed = Failed {
            step: 1,
            lane: (T::LANES > 1).then(|| bad.unwrap_or(0)),
            clock: self.prepared.description().clock().into(),
            begin: from.t.to_f64(),
            end: t.to_f64(),
            q: numbers(&point.q),
            p: numbers(&point.p),
            energy: undefined.map(|(_, energy)| energy),
        };
        failed.because(cause)
    }
}

impl<T: Real> Clock<T> {
    /// The number of steps to `t` after `made`: (none, this number), or the numbers before and
    /// after it if no number leads there. `clock` is the name of the time.
    pub(crate) fn whole_steps(
        &self,
        made: u64,
        t: T,
        clock: &str,
    ) -> Result<(Option<u64>, u64), TimeError> {
        /// The largest number of steps that is exact in `f64`.
        const LARGEST_EXACT: f64 = (1_u64 << 53) as f64;
        let since = Clock::new(self.start, self.interval);
        let made = self.first + made;
        let count = ((t - self.start) / self.interval).to_f64();
        let nearest = (count.clamp(0.0, LARGEST_EXACT) + 0.5) as u64;
        let reached = since.at(nearest);
        // t, the start and the interval are each off by half an ulp at most, and so are the
        // product and the sum in `at`; decimal steps such as 0.001 are rounded to f64 by the
        // user, whatever the scalar.
        let size = t.magnitude() + self.start.magnitude() + (reached - self.start).magnitude();
        let rounding = T::epsilon().max(f64::EPSILON) * size;
        let counted = t.is_finite() && count < LARGEST_EXACT;
        let meets = counted && (reached - t).magnitude() <= rounding;
        if meets && nearest >= made {
            return Ok((None, nearest - made));
        }
        let behind = count < made as f64;
        if behind {
            return Err(TimeError::Behind {
                clock: clock.into(),
                target: t.to_f64(),
                now: since.at(made).to_f64(),
            });
        }
        if !counted {
            return Err(TimeError::Unreachable {
                clock: clock.into(),
                target: t.to_f64(),
            });
        }
        let before = (count as u64).max(made);
        Ok((Some(before - made), before + 1 - made))
    }
}

impl<T: Real, S: System, R: MapOf<T, S>, O> Integrator<T, S, R, O> {
    /// The state at a time at most one step before or after the present one, by a shorter step of a copy. Its error
    /// has the order of the scheme, and the run does not change.
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
    /// [`TimeError::Far`] for a time further away; [`StepError::NotFinite`] and [`StepError::Unsolved`], in which the
    /// step has the number 1.
    pub fn state_at(&self, t: T) -> Result<State<VectorOf<S, T>>, Error> {
        self.part().state_at(t)
    }
}

impl<T: Real, S: System, R: MapOf<T, S>, O: Observer<T, S>> Integrator<T, S, R, O> {
    /// Makes all whole steps up to `t`, and returns the state at `t`, which may be any later time. The rest of the time is
    /// one shorter step on a copy. Observers receive the states after whole steps only. An event in the shorter step is
    /// located by the next whole step.
    ///
    /// If the length of steps varies in time, the run itself makes the step that passes `t`, since the length of a step
    /// is known only after it.
    ///
    /// If an observer ends the run before `t`, the state at which it did is returned; see
    /// [`has_ended`](Integrator::has_ended).
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
            Some(_) => self.state_at(t),
        }
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
        while !self.ended {
            let (behind, ahead) = match is_forward {
                true => (self.state.t, t),
                false => (t, self.state.t),
            };
            if !behind.lt(ahead).any() {
                return self.state_at(t);
            }
            self.advance(1)?;
        }
        Ok(self.state.clone())
    }

    /// Makes the whole number of steps that leads to the time `t`.
    ///
    /// The step size does not change. If no whole number of steps leads to `t`, up to the rounding of `t`, of the step
    /// and of the start, this is an error and no step is made. [`advance_until`](Integrator::advance_until) takes any
    /// time.
    ///
    /// # Errors
    /// [`TimeError::OffGrid`] with the reachable times on both sides, [`TimeError::Behind`],
    /// [`TimeError::Unreachable`], [`TimeError::Uneven`] where steps have no known duration; those of
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

    /// The number of steps to `t`, as in [`Clock::whole_steps`].
    fn whole_steps(&self, t: T) -> Result<(Option<u64>, u64), TimeError> {
        let clock = self.prepared.description().clock();
        (self.clock).whole_steps(self.steps - self.began, t, clock)
    }

    /// The states at the given times, which are in the order of the run, independent of the step. The iterator ends if an
    /// observer ends the run. The first error is the last item.
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
}
