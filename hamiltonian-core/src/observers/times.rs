//! States of a run at given times, independent of its step.
//!
//! Input: times, and an observer. Output: the observer receives the states at those times. Invariant: no
//! bit of the run changes; the states are those of [`state_at`](crate::Integrator::state_at).

use crate::errors::{Error, TimeError};
use crate::observers::observe::{Observer, View, one_trajectory};
use crate::results::checkpoint::Memory;
use crate::systems::state::State;
use crate::systems::system::{Dynamics, System, VectorOf};
use crate::systems::vector::{Shape, Vector};
use core::ops::ControlFlow;
use hamiltonian_lanes::{Mask, Real};

/// Makes an observer that passes on the states at the given times.
///
/// The times must be in the order of the run. A state between two steps is computed on a copy of the run, by a shorter
/// step. The iterator of times may be infinite: times after the last step of the run are not used. A time before the
/// state at which the observer is attached is an error. The `step` of the view is the number of the step that leads to
/// the time or past it.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
///
/// let tenths = (0..).map(|k| 0.1 * f64::from(k));
/// let mut run = Integrator::new(&Oscillator {}, StormerVerlet::default(), State::new([1.0], [0.0]), 0.03)?
///     .observe(at_times(tenths, Recorder::new()));
/// run.advance(34)?;
/// let recorder = run.observer().inner();
/// assert_eq!(recorder.rows(), 11);
/// for row in recorder.iter() {
///     assert!((row[1] - row[0].cos()).abs() < 1e-4);
/// }
/// # Ok::<(), Error>(())
/// ```
pub fn at_times<V: Vector, I: IntoIterator<Item = V::Scalar>, O>(
    times: I,
    observer: O,
) -> AtTimes<V, I::IntoIter, O> {
    AtTimes {
        times: times.into_iter(),
        next: None,
        shown: 0,
        before: None,
        end: None,
        failure: None,
        inner: observer,
    }
}

/// The observer that [`at_times`] makes.
#[derive(Debug, Clone)]
pub struct AtTimes<V: Vector, I, O> {
    times: I,
    /// The next time.
    next: Option<V::Scalar>,
    /// The number of times that were passed on.
    shown: u64,
    before: Option<State<V>>,
    end: Option<State<V>>,
    failure: Option<Error>,
    inner: O,
}

impl<V: Vector, I, O> AtTimes<V, I, O> {
    /// The observer inside.
    pub fn inner(&self) -> &O {
        &self.inner
    }

    /// Returns the observer inside.
    pub fn into_inner(self) -> O {
        self.inner
    }
}

impl<V: Vector, I: Iterator<Item = V::Scalar>, O> AtTimes<V, I, O> {
    /// Passes on the states at the times from `before`, a state of the run, up to the current
    /// state.
    fn show<S: System<Shape: Shape<Vector<V::Scalar> = V>>>(
        &mut self,
        view: &View<'_, V::Scalar, S>,
        before: &State<V>,
    ) -> Result<ControlFlow<()>, Error>
    where
        O: Observer<V::Scalar, S>,
    {
        let zero = V::Scalar::zero();
        let backwards = view.between.interval().lt(zero).any();
        // True if a comes before b in the run.
        let comes_before = |a: V::Scalar, b: V::Scalar| match backwards {
            true => b.lt(a).any(),
            false => a.lt(b).any(),
        };
        // Decimal times are rounded to `f64` by the user, whatever the scalar.
        let epsilon = 2.0 * V::Scalar::epsilon().max(f64::EPSILON);
        let meets = |a: V::Scalar, b: V::Scalar| {
            (a - b).magnitude() <= epsilon * (a.magnitude() + b.magnitude())
        };
        let is_due = |t: &V::Scalar| !comes_before(view.state.t, *t) || meets(view.state.t, *t);
        while let Some(t) = self.next.filter(is_due) {
            let is_behind = comes_before(t, before.t) && !meets(t, before.t);
            let target = t.to_f64();
            let clock = || view.prepared.description().clock().into();
            if is_behind {
                let now = before.t.to_f64();
                return Err(TimeError::Behind {
                    clock: clock(),
                    target,
                    now,
                }
                .into());
            }
            if !t.is_finite() {
                return Err(TimeError::Unreachable {
                    clock: clock(),
                    target,
                }
                .into());
            }
            let state = match meets(t, view.state.t) {
                true => view.state.clone(),
                false => view.between.part(before, t - before.t)?,
            };
            let shown = View {
                state: &state,
                ..*view
            };
            let verdict = match self.shown {
                0 => self.inner.attach(&shown),
                _ => self.inner.observe(&shown),
            };
            self.shown += 1;
            self.next = self.times.next();
            if verdict.is_break() {
                let end = self.inner.end()?.cloned();
                self.end = Some(end.unwrap_or(state));
                return Ok(verdict);
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Passes on the requested states between `before` and the current state, and stores its
    /// position.
    fn go<S: System<Shape: Shape<Vector<V::Scalar> = V>>>(
        &mut self,
        view: &View<'_, V::Scalar, S>,
        mut before: State<V>,
    ) -> ControlFlow<()>
    where
        O: Observer<V::Scalar, S>,
    {
        self.end = None;
        let shown = self.show(view, &before);
        // If it ended the run, times of the same step may follow.
        before.clone_from(self.end.as_ref().unwrap_or(view.state));
        self.before = Some(before);
        shown.unwrap_or_else(|error| {
            self.failure = Some(error);
            ControlFlow::Break(())
        })
    }
}

impl<T, S, I, O> Observer<T, S> for AtTimes<VectorOf<S, T>, I, O>
where
    T: Real,
    S: System,
    I: Iterator<Item = T>,
    O: Observer<T, S>,
{
    fn attach(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        one_trajectory::<T>();
        self.next = self.times.next();
        self.go(view, view.state.clone())
    }

    fn observe(&mut self, view: &View<'_, T, S>) -> ControlFlow<()> {
        let before = self.before.take();
        self.go(view, before.unwrap_or_else(|| view.state.clone()))
    }

    fn change(&mut self, from: &View<'_, T, S>, to: &View<'_, T, S>) {
        // Another observer may have ended the run between two steps: times before that belong to the state before the
        // change. The inner observer cannot end a run that goes on.
        if self.failure.is_none()
            && let Some(before) = self.before.take()
        {
            let _ = self.go(from, before);
        }
        self.before = Some(to.state.clone());
        self.end = None;
        if self.shown > 0 {
            self.inner.change(from, to);
        }
    }

    fn save(&self, to: &mut Memory) {
        to.begin("AtTimes");
        to.count(self.shown);
        for state in [&self.before, &self.end] {
            to.option(state.as_ref());
        }
        self.inner.save(to);
    }

    fn restore(&mut self, view: &View<'_, T, S>, from: &mut Memory) -> Result<(), Error> {
        from.expect("AtTimes")?;
        self.shown = from.read_count()?;
        self.next = self
            .times
            .nth(usize::try_from(self.shown).unwrap_or(usize::MAX));
        self.before = from.read_option(view.state)?;
        self.end = from.read_option(view.state)?;
        self.inner.restore(view, from)
    }

    fn end(&self) -> Result<Option<&State<VectorOf<S, T>>>, Error> {
        match &self.failure {
            Some(error) => Err(error.clone()),
            None => Ok(self.end.as_ref()),
        }
    }
}
