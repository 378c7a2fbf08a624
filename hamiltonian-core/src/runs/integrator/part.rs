//! Parts of a step: the state of a run between its steps.
//!
//! Input: the current state of a run and a time. Output: the state at that time, by one step of
//! another size of a copy, of the scheme's own order. Invariant: no bit of the run changes.

use super::{MapOf, check_scheme, numbers};
use crate::errors::{Error, StepError, TimeError};
use crate::flows::map::{Clock, Map, ScalarOf, Step};
use crate::observers::observe::{Between, View};
use crate::runs::failed::Failed;
use crate::schemes::scheme::Scheme;
use crate::systems::domain;
use crate::systems::flow::Scratch;
use crate::systems::state::{Carried, Point, State};
use crate::systems::system::{Dynamics, System, VectorOf};
use crate::systems::vector::Vector;
use alloc::format;
use alloc::string::String;
use core::cell::RefCell;
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
pub(crate) struct Part<'a, T: Real, S: System, R: Map> {
    pub(crate) prepared: &'a S::Prepared<T>,
    pub(crate) recipe: &'a dyn Recipe<T, S, R>,
    pub(crate) state: &'a State<VectorOf<S, T>>,
    pub(crate) step: T,
    pub(crate) clock: Clock<T>,
    /// The approximate length of the next step, if it is not the interval of the clock.
    pub(crate) duration: Option<T>,
    /// The last step, if the map makes parts of its steps and this is the state after it.
    pub(crate) last: Option<LastStep<'a, R>>,
}

/// The last step of a run.
pub(crate) struct LastStep<'a, R: Map> {
    /// The map of its steps; it is made again if it is `None`.
    pub(crate) map: Option<&'a R>,
    /// The carried value after it.
    pub(crate) carried: &'a R::Carried,
    /// The scratch of the run; a new one is made if it is `None`.
    pub(crate) work: RefCell<Option<&'a mut R::Work>>,
}

impl<'a, R: Map> LastStep<'a, R> {
    /// The last of `made` steps of the clock, if there is one, if its map makes parts of it, and if the run stands at its
    /// end `t`: an observer may have ended it before.
    pub(crate) fn of(
        map: &'a R,
        carried: &'a R::Carried,
        work: Option<&'a mut R::Work>,
        clock: Clock<ScalarOf<R>>,
        made: u64,
        t: ScalarOf<R>,
    ) -> Option<Self> {
        let stands = made > 0 && carried.time(clock.at(made)).equals(t).all();
        let map = Some(map).filter(|map| stands && map.has_parts());
        let work = RefCell::new(work);
        map.is_some().then_some(LastStep { map, carried, work })
    }
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
        let by = (t - now) / self.clock.interval;
        match self.near_last_step(t, by) {
            Some(state) => Ok(state),
            None => self.at(self.state, t, by),
        }
    }

    fn part(&self, from: &State<VectorOf<S, T>>, time: T) -> Result<State<VectorOf<S, T>>, Error> {
        let interval = self.clock.interval;
        let t = from.t + time;
        let since = match from.t.equals(self.state.t).all() {
            true => T::zero(),
            false => self.between(from.t, self.state.t),
        };
        match self.near_last_step(t, (time - since) / interval) {
            Some(state) if !time.equals(T::zero()).all() => Ok(state),
            _ => self.at(from, t, time / interval),
        }
    }

    fn steps_to(&self, t: T) -> u64 {
        let left = t - self.state.t;
        let steps = |last: &LastStep<'_, R>| last.carried.steps_within(self.clock.interval, left);
        self.last.as_ref().map_or(1, steps)
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

    /// The state at `t`, `by` step sizes from the current one, by a part of the last step; `None` if there is no such part,
    /// or if it fails.
    fn near_last_step(&self, t: T, by: T) -> Option<State<VectorOf<S, T>>> {
        /// The farthest time ahead, in units of the last step: the guess is extrapolated to there.
        const FARTHEST: f64 = 1.5;
        /// How far the beginning of the step may be passed: a time may be rounded.
        const BEFORE: f64 = -1.001;
        let last = self.last.as_ref()?;
        let made;
        let map = match last.map {
            Some(map) => map,
            None => {
                made = self.recipe.prepare(self.prepared, Step::of(self.step));
                &made
            }
        };
        let size = map.last_step(last.carried);
        let at = by / size;
        let is_near = T::constant(BEFORE, 0.0).le(at) & at.le(T::constant(FARTHEST, 0.0));
        if !is_near.all() || by.equals(T::zero()).all() {
            return None;
        }
        let mut carried = last.carried.clone();
        let mut fresh;
        let mut of_run = last.work.borrow_mut();
        let work = match &mut *of_run {
            Some(work) => &mut **work,
            None => {
                fresh = Scratch::like(&carried);
                &mut fresh
            }
        };
        map.part(self.state.t, by, size, &mut carried, work);
        let Point { q, p } = carried.point().clone();
        let state = State { t, q, p };
        let is_made = carried.is_finite() && domain::is_inside::<T, S>(self.prepared, &state);
        is_made.then_some(state)
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
                // A carried time that was reached up to rounding is the time.
                let state = State {
                    t,
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
        let made = self.first.magnitude() as u64 + made;
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
