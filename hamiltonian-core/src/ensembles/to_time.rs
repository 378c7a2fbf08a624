//! Members whose steps vary in time, advanced to a time.
//!
//! Input: members in memory and a time. Output: their states at that time. Invariant: each member has the bits of a single
//! run: it makes the step that passes the time, and its state there is made by a part of that step.

use super::Member;
use super::bound;
use super::chunk::{ChunkHost, Decision, Finished, observe};
use super::guard::guard;
use super::host::{Host, MemberRun, RunAtStop};
use super::in_memory::Ensemble;
use super::rounding::Rounding;
use super::threads;
use crate::errors::{Error, SweepError};
use crate::observers::observe::{FollowedQuantities, Observer, View};
use crate::schemes::scheme::Scheme;
use crate::schemes::{Adaptive, ToTolerance, Tolerance};
use crate::systems::state::State;
use crate::systems::system::{Description, System, VectorOf};
use alloc::vec::Vec;
use core::ops::ControlFlow;

/// The state of a member at a time, or its error.
type StateAt<S> = Result<State<VectorOf<S>>, Error>;

/// The host of a chunk whose members advance to a time.
struct TimeHost<'a, S: System, O, F> {
    of: ChunkHost<'a, S, O, F>,
    t: f64,
    /// The states at that time.
    states: Vec<Option<StateAt<S>>>,
}

impl<S, O, F> Host<f64, S> for TimeHost<'_, S, O, F>
where
    S: System,
    O: Observer<f64, S>,
    F: FnMut(usize, &mut O, &View<'_, f64, S>) -> Decision<S>,
{
    fn load(&mut self, slot: &mut Option<MemberRun<f64, S>>) -> bool {
        let is_loaded = self.of.load(slot);
        // The first stop is where the member stands: it may have passed the time.
        if let Some(run) = slot.as_mut().filter(|_| is_loaded) {
            run.stop = run.made;
        }
        is_loaded
    }

    fn receive(&mut self, key: usize, run: RunAtStop<'_, f64>, view: &View<'_, f64, S>) -> bool {
        // The observer has received the state at which the member is loaded.
        let is_new = view.steps > self.of.chunk.made(key, self.of.common);
        let observer = &mut self.of.chunk.observers[key];
        let receive = &mut self.of.receive;
        let decision = match is_new {
            true => guard(|| receive(key, observer, view)),
            false => Ok(ControlFlow::Continue(())),
        };
        match decision {
            Ok(ControlFlow::Continue(())) => {}
            Ok(ControlFlow::Break(end)) => return self.of.end(key, view, end),
            Err(error) => return self.of.end(key, view, Err(error)),
        }
        let (behind, ahead) = match view.between.interval() > 0.0 {
            true => (view.state.t, self.t),
            false => (self.t, view.state.t),
        };
        if behind < ahead {
            let due = self.of.stop(key, view.steps);
            *run.stop = due.min(view.steps + view.between.steps_to(self.t));
            return true;
        }
        self.states[key] = Some(view.state_at(self.t));
        false
    }

    fn pass(&mut self, key: usize, view: &View<'_, f64, S>, signs_kept: bool) -> bool {
        self.of.pass(key, view, signs_kept)
    }

    fn take_drifts(
        &mut self,
        key: usize,
        system: &Description,
        followed: &mut FollowedQuantities<f64>,
    ) {
        self.of.take_drifts(key, system, followed);
    }

    fn phase(&self) -> u64 {
        self.of.phase()
    }

    fn leave(&mut self, run: &mut MemberRun<f64, S>) {
        self.of.leave(run);
    }

    fn fail(&mut self, run: &mut MemberRun<f64, S>, error: Error) {
        self.of.fail(run, error);
    }

    fn observes(&self) -> bool {
        true
    }

    fn is_cancelled(&mut self) -> bool {
        false
    }
}

impl<S: ToTolerance> Ensemble<S, Adaptive<S::Scheme>>
where
    Adaptive<S::Scheme>: Scheme<S>,
{
    /// Creates an ensemble of members with steps from a tolerance, each its own, by the scheme that
    /// [`Integrator::to_tolerance`](crate::Integrator::to_tolerance) takes. A tolerance that is not positive is the error of
    /// each member.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let make = |member: Member| (Oscillator {}, State::new([member.index as f64], [0.0]));
    /// let mut swarm = Ensemble::to_tolerance(4, make, 1e-10)?;
    /// for t in [1.0, 10.0] {
    ///     for (index, state) in swarm.advance_until(t)?.enumerate() {
    ///         let state = state?;
    ///         assert_eq!(state.t, t);
    ///         assert!((state.q[0] - index as f64 * t.cos()).abs() < 1e-8);
    ///     }
    /// }
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`SweepError::NoMembers`].
    pub fn to_tolerance(
        count: usize,
        make: impl FnMut(Member) -> (S, State<VectorOf<S>>),
        tolerance: impl Into<Tolerance>,
    ) -> Result<Self, Error> {
        let scheme = Adaptive::new(S::Scheme::default(), tolerance);
        Self::new(count, make, scheme, 1.0)
    }
}

impl<S: System, M: Scheme<S>, O: Observer<f64, S> + Send, A: Rounding> Ensemble<S, M, O, A> {
    /// Advances each member to the end of the step that passes `t`, and returns the states at `t`, in the order of the
    /// index.
    pub(super) fn pass_time(&mut self, t: f64) -> Vec<StateAt<S>> {
        let (scheme, common) = (&*self.scheme, &self.common);
        let none = |count: usize| (0..count).map(|_| None).collect();
        let mut hosts: Vec<_> = self
            .chunks
            .iter_mut()
            .map(|chunk| {
                if chunk.steps.is_empty() {
                    chunk.steps = alloc::vec![common.steps; chunk.count];
                }
                TimeHost {
                    states: none(chunk.count),
                    of: ChunkHost {
                        chunk,
                        common,
                        left: u64::MAX,
                        observes: true,
                        attaches: false,
                        evaluates_in_lanes: false,
                        next: 0,
                        receive: |_: usize, observer: &mut O, view: &View<'_, f64, S>| {
                            observe(observer, view)
                        },
                    },
                    t,
                }
            })
            .collect();
        threads::for_each(&mut hosts, self.threads, |host| {
            bound::drive::<f64, S, M, O, A>(scheme, host);
        });
        let mut all = Vec::new();
        let mut most = common.steps;
        for TimeHost { of, states, .. } in hosts {
            let chunk = of.chunk;
            for (key, state) in states.into_iter().enumerate() {
                let error = |error: &Error| SweepError::member(chunk.first + key, error.clone());
                if !chunk.finished.contains_key(&key) {
                    most = most.max(chunk.steps[key]);
                }
                all.push(match (chunk.finished.get(&key), state) {
                    (Some(Finished::Failed(cause, _)), _) => Err(error(cause)),
                    (Some(Finished::Ended(state, _)), _) => Ok((**state).clone()),
                    (None, Some(state)) => state.map_err(|cause| error(&cause)),
                    (None, None) => Err(SweepError::NoMembers.into()),
                });
            }
        }
        self.common.steps = most;
        all
    }
}
