//! The host of a chunk of a sweep.
//!
//! Input: indices. Output: a [`Batch`] of records. Invariant: a member's numbers depend only on its index, the sweep
//! and its seed.

use super::{EndPoint, Sweep};
use crate::ensembles::Member;
use crate::ensembles::bound;
use crate::ensembles::change::Standing;
use crate::ensembles::guard::guard;
use crate::ensembles::host::{Host, MemberRun, RunAtStop};
use crate::ensembles::record::{Batch, End, MemberOutcome, Record, Status};
use crate::ensembles::rounding::Rounding;
use crate::errors::{Error, SweepError};
use crate::flows::map::Clock;
use crate::observers::observe::{FollowVisitor, FollowedQuantities, Observer, View};
use crate::runs::integrator::{check_start, check_step, duration};
use crate::schemes::scheme::Scheme;
use crate::systems::hash::hash_of;
use crate::systems::state::State;
use crate::systems::system::{Description, Dynamics, System, VectorOf};
use alloc::vec::Vec;
use core::ops::{ControlFlow, Range};

/// A member that has not ended.
struct ActiveMember<O> {
    member: Member,
    observer: O,
    is_attached: bool,
    /// True if lanes evaluate everything that its observer needs.
    is_followed: bool,
    /// The time at which it ends, if one is set; otherwise NaN.
    end: f64,
    /// The number of whole steps after which it is recorded next; `None` if steps differ in duration.
    target: Option<u64>,
    step: f64,
    clock: Clock<f64>,
    /// The number of times at which it has been recorded.
    recorded: usize,
    values: Vec<f64>,
}

/// `Break` at the end of a member, with its state there, and true if its observer ended it.
type EndOrContinue<S, C = ()> = ControlFlow<(State<VectorOf<S>>, bool), C>;

/// The members of a chunk, at their starts, running or ended.
pub(crate) struct SweepHost<'r, 'a, S: System, M, O, A> {
    sweep: &'r Sweep<'a, S, M, O, Record<'a, S, O>, A>,
    indices: Range<usize>,
    /// The number of the next member in the chunk.
    next: usize,
    active: Vec<Option<ActiveMember<O>>>,
    outcomes: Vec<Option<MemberOutcome>>,
    /// The hash of each member; empty if members are not hashed.
    hashes: Vec<u64>,
    values: Vec<f64>,
    words: Vec<f64>,
    /// True if steps differ in duration.
    varies: bool,
    cancelled: bool,
}

impl<'r, 'a, S, M, O, A> SweepHost<'r, 'a, S, M, O, A>
where
    S: System,
    M: Scheme<S>,
    O: Observer<f64, S>,
    A: Rounding,
{
    pub(crate) fn new(
        sweep: &'r Sweep<'a, S, M, O, Record<'a, S, O>, A>,
        indices: Range<usize>,
        hashes: bool,
    ) -> Self {
        let none = |_| None;
        SweepHost {
            sweep,
            next: 0,
            active: indices.clone().map(|_| None).collect(),
            outcomes: indices.clone().map(none).collect(),
            hashes: alloc::vec![0; if hashes { indices.len() } else { 0 }],
            indices,
            values: Vec::new(),
            words: Vec::new(),
            varies: false,
            cancelled: false,
        }
    }

    /// Advances all members to their ends.
    pub(crate) fn batch(mut self) -> Batch {
        let sweep = self.sweep;
        bound::drive::<f64, S, M, O, A>(&sweep.scheme, &mut self);
        let missing = |outcome: Option<MemberOutcome>| {
            outcome.unwrap_or(MemberOutcome {
                status: Status::Missing,
                time: f64::NAN,
                steps: 0,
                values: 0..0,
                hash: 0,
                error: None,
            })
        };
        Batch {
            first: self.indices.start,
            nan: sweep.record.columns.iter().map(|_| f64::NAN).collect(),
            rows_each: sweep.record.rows_each(),
            outcomes: self.outcomes.into_iter().map(missing).collect(),
            values: self.values,
            cancelled: self.cancelled,
        }
    }

    /// Makes member `key`, and loads its run into the slot.
    fn make(&mut self, key: usize, slot: &mut Option<MemberRun<f64, S>>) -> Result<(), Error> {
        let sweep = self.sweep;
        let member = Member::new(self.indices.start + key, sweep.seed);
        let (system, start) = guard(|| (sweep.make)(member)).and_then(|made| made)?;
        let step = match &sweep.step_each {
            Some(each) => guard(|| each(member))?,
            None => sweep.step,
        };
        if let Some(hash) = self.hashes.get_mut(key) {
            *hash = hash_of(&system, &start, step);
        }
        check_step(step)?;
        let prepared = check_start(&system, &start)?;
        if let Some(run) = slot
            && !S::fits(&run.prepared, &prepared)
        {
            return Err(SweepError::OtherSizes {
                system: (&*system.description().name).into(),
            }
            .into());
        }
        self.words.clear();
        (sweep.erased()).begin(&prepared, &start, step, &mut self.words)?;
        let clock = Clock::new(start.t, step * duration::<f64>(&sweep.erased().entry()));
        self.varies = sweep.erased().varies(&prepared, &start, step);
        let end = match &sweep.end {
            EndPoint::Each(end) => guard(|| end(member))?,
            EndPoint::Until(end) => *end,
            EndPoint::Steps(_) | EndPoint::Unknown => f64::NAN,
        };
        let mut active = ActiveMember {
            member,
            observer: guard(|| (sweep.observer)(member))?,
            is_attached: false,
            is_followed: false,
            end,
            target: None,
            step,
            clock,
            recorded: 0,
            values: Vec::new(),
        };
        self.set_target(&mut active, prepared.description(), clock, 0)?;
        // An observer that receives no states is not attached.
        let observes = active.observer.interval() < u64::MAX;
        let interval = active.observer.interval();
        // Reuses the storage of the previous run.
        let mut followed = match slot {
            Some(run) => core::mem::take(&mut run.followed),
            None => FollowedQuantities::default(),
        };
        FollowVisitor::list(prepared.description(), &mut followed, |visitor| {
            active.observer.follow(visitor)
        });
        // An observer of signs computes the previous values of its functions when it is attached.
        if !followed.sections.is_empty() {
            followed = FollowedQuantities::default();
        }
        (followed.drifts.iter_mut()).for_each(|track| track.drift = None);
        active.is_followed = !followed.is_empty();
        active.is_attached = !observes || active.is_followed;
        let stop = if active.is_attached {
            self.stop(&active, 0, 1)
        } else {
            0
        };
        match slot {
            Some(run) => {
                run.system_changed |= !S::equals(&run.prepared, &prepared);
                run.words.copy_from_slice(&self.words);
                run.prepared = prepared;
                run.state = start;
                (run.key, run.clock, run.step) = (key, clock, step);
                (run.made, run.began, run.stop) = (0, 0, stop);
                (run.followed, run.interval) = (followed, interval);
                (run.since, run.received) = (0, 0);
            }
            None => {
                *slot = Some(MemberRun {
                    key,
                    prepared,
                    system_changed: true,
                    step,
                    clock,
                    made: 0,
                    began: 0,
                    stop,
                    words: self.words.clone(),
                    followed,
                    interval,
                    since: 0,
                    received: 0,
                    state: start,
                });
            }
        }
        self.active[key] = Some(active);
        Ok(())
    }

    /// Returns the time at which a member is recorded next; `None` if it ends after a number of steps.
    fn time(&self, active: &ActiveMember<O>) -> Option<f64> {
        match (&self.sweep.record.times, &self.sweep.end) {
            (Some(times), _) => times.get(active.recorded).copied(),
            (None, EndPoint::Steps(_)) => None,
            (None, _) => Some(active.end),
        }
    }

    /// Sets the number of whole steps after which a member is recorded next.
    fn set_target(
        &self,
        active: &mut ActiveMember<O>,
        system: &Description,
        clock_of: Clock<f64>,
        made: u64,
    ) -> Result<(), Error> {
        active.target = match (self.time(active), &self.sweep.end) {
            (Some(t), _) if self.varies && t.is_finite() => {
                // The clock has the start and the direction, but not the times of these steps.
                let is_behind = (t - clock_of.start) * clock_of.interval < 0.0;
                if is_behind {
                    clock_of.whole_steps(0, t, system.clock())?;
                }
                None
            }
            (Some(t), _) => {
                let (before, after) = clock_of.whole_steps(made, t, system.clock())?;
                Some(made + before.unwrap_or(after))
            }
            (None, EndPoint::Steps(n)) => Some(*n),
            (None, _) => Some(made),
        };
        Ok(())
    }

    /// Returns the number of steps at the next stop of a member. `ahead` more steps are sure to end before it is recorded
    /// next, if steps differ in duration.
    fn stop(&self, active: &ActiveMember<O>, made: u64, ahead: u64) -> u64 {
        let interval = match active.is_followed {
            true => u64::MAX,
            false => active.observer.interval().max(1),
        };
        let changes = self.sweep.each.as_ref().map_or(u64::MAX, |(n, _)| *n);
        let next = |interval: u64| (made / interval).saturating_add(1).saturating_mul(interval);
        next(interval)
            .min(next(changes))
            .min(active.target.unwrap_or(made + ahead))
    }

    /// Passes a state to the observer of a member. Returns the end of the member if the observer ended it.
    fn observe(
        &self,
        active: &mut ActiveMember<O>,
        view: &View<'_, f64, S>,
    ) -> Result<EndOrContinue<S>, Error> {
        let verdict = if !active.is_attached {
            active.is_attached = true;
            active.observer.attach(view)
        } else if !active.is_followed
            && (view.steps).is_multiple_of(active.observer.interval().max(1))
        {
            active.observer.observe(view)
        } else {
            ControlFlow::Continue(())
        };
        if verdict.is_continue() {
            return Ok(ControlFlow::Continue(()));
        }
        let end = active.observer.end()?.unwrap_or(view.state).clone();
        Ok(ControlFlow::Break((end, true)))
    }

    /// Records a member at the times that are due: those up to the state and, if the state is the one from which the
    /// member goes on, those before the next step. Returns the end of the member if it is among them.
    fn record(
        &self,
        active: &mut ActiveMember<O>,
        view: &View<'_, f64, S>,
        goes_on: bool,
    ) -> Result<EndOrContinue<S>, Error> {
        let clock_of = Clock::new(view.between.start(), view.between.interval());
        loop {
            let Some(t) = self.time(active) else {
                let is_there = active.target == Some(view.steps);
                return Ok(match is_there {
                    true => ControlFlow::Break((view.state.clone(), false)),
                    false => ControlFlow::Continue(()),
                });
            };
            let forward = view.between.interval() > 0.0;
            let is_passed = match active.target {
                Some(target) => target == view.steps,
                None if forward => view.state.t >= t,
                None => view.state.t <= t,
            };
            if !is_passed {
                return Ok(ControlFlow::Continue(()));
            }
            let meets = match active.target {
                Some(_) => clock_of.whole_steps(view.steps, t, "")?.0.is_none(),
                None => view.state.t.to_bits() == t.to_bits(),
            };
            if active.target.is_some() && !meets && !goes_on {
                return Ok(ControlFlow::Continue(()));
            }
            let state = match meets {
                true => view.state.clone(),
                false => view.state_at(t)?,
            };
            let Some(times) = &self.sweep.record.times else {
                return Ok(ControlFlow::Break((state, false)));
            };
            active.recorded += 1;
            if active.recorded >= times.len() {
                return Ok(ControlFlow::Break((state, false)));
            }
            self.write(active, view, &state, false);
            self.set_target(active, view.prepared.description(), clock_of, view.steps)?;
        }
    }

    /// Passes a state to the observer of a member, lets the closure of the sweep change it, and records what is due: up
    /// to this step before the change, between this step and the next one from the changed state. Returns the end of the
    /// member if this is its end, and otherwise true if it was changed; `words` then has its carried value.
    fn decide(
        &self,
        active: &mut ActiveMember<O>,
        words: &mut Vec<f64>,
        view: &View<'_, f64, S>,
    ) -> Result<EndOrContinue<S, bool>, Error> {
        let mut decision = self.observe(active, view)?;
        if decision.is_continue() {
            decision = self.record(active, view, false)?;
        }
        let mut changed = None;
        let standing = Standing {
            scheme: &self.sweep.scheme,
            prepared: view.prepared,
            step: active.step,
            clock: active.clock,
            made: view.steps,
        };
        if decision.is_continue() {
            if let Some((n, closure)) = &self.sweep.each
                && view.steps > 0
                && view.steps.is_multiple_of(*n)
            {
                let member = active.member;
                let closure = |state: &mut State<VectorOf<S>>| closure(member, state);
                changed = standing.change(view.state, closure, &mut active.observer, words)?;
            }
            decision = match &changed {
                Some(state) => self.record(active, &standing.part(state).view(view.steps), true)?,
                None => self.record(active, view, true)?,
            };
        }
        Ok(match decision {
            ControlFlow::Continue(()) => ControlFlow::Continue(changed.is_some()),
            ControlFlow::Break((state, stopped)) => {
                self.write(active, view, &state, stopped);
                ControlFlow::Break((state, stopped))
            }
        })
    }

    /// Records a member at a state.
    fn write(
        &self,
        active: &mut ActiveMember<O>,
        view: &View<'_, f64, S>,
        state: &State<VectorOf<S>>,
        stopped: bool,
    ) {
        let end = End {
            member: active.member,
            state,
            observer: &active.observer,
            steps: view.steps,
            stopped,
            prepared: view.prepared,
        };
        (self.sweep.record.write)(&end, &mut active.values);
    }

    /// Records the end of a member, or its error. Returns false: the member does not continue.
    fn end(
        &mut self,
        key: usize,
        active: &ActiveMember<O>,
        view: &View<'_, f64, S>,
        end: Result<(State<VectorOf<S>>, bool), Error>,
    ) -> bool {
        let values = &active.values;
        match end {
            Ok((state, stopped)) => {
                let status = match stopped {
                    true => Status::Stopped,
                    false => Status::Ended,
                };
                self.finish(key, status, state.t, view.steps, values, None);
            }
            Err(error) => {
                let status = Status::of(&error, true);
                self.finish(key, status, view.state.t, view.steps, values, Some(error));
            }
        }
        false
    }

    /// Writes the outcome of a member.
    fn finish(
        &mut self,
        key: usize,
        status: Status,
        time: f64,
        steps: u64,
        values: &[f64],
        error: Option<Error>,
    ) {
        let begin = self.values.len();
        self.values.extend_from_slice(values);
        let index = self.indices.start + key;
        let error = error.map(|error| SweepError::member(index, error));
        self.outcomes[key] = Some(MemberOutcome {
            status,
            time,
            steps,
            values: begin..self.values.len(),
            hash: self.hashes.get(key).copied().unwrap_or(0),
            error,
        });
    }
}

impl<S, M, O, A> Host<f64, S> for SweepHost<'_, '_, S, M, O, A>
where
    S: System,
    M: Scheme<S>,
    O: Observer<f64, S>,
    A: Rounding,
{
    fn load(&mut self, slot: &mut Option<MemberRun<f64, S>>) -> bool {
        while self.next < self.indices.len() {
            if self.is_cancelled() {
                return false;
            }
            let key = self.next;
            self.next += 1;
            match self.make(key, slot) {
                Ok(()) => return true,
                Err(error) => {
                    let status = Status::of(&error, false);
                    self.finish(key, status, f64::NAN, 0, &[], Some(error));
                }
            }
        }
        false
    }

    fn receive(&mut self, key: usize, run: RunAtStop<'_, f64>, view: &View<'_, f64, S>) -> bool {
        let Some(mut active) = self.active[key].take() else {
            return false;
        };
        let RunAtStop {
            stop,
            followed,
            words,
            began,
        } = run;
        match guard(|| self.decide(&mut active, words, view)).and_then(|decision| decision) {
            Ok(ControlFlow::Continue(is_changed)) => {
                if is_changed {
                    *began = view.steps;
                }
                let is_first = !active.is_followed && view.steps == 0;
                if is_first || is_changed && active.is_followed {
                    FollowVisitor::list(view.prepared.description(), followed, |visitor| {
                        active.observer.follow(visitor)
                    });
                    active.is_followed = !followed.is_empty();
                }
                // A change restarts the scheme.
                let time = self.time(&active).filter(|_| !is_changed);
                let ahead = time.map_or(1, |t| view.between.steps_to(t));
                *stop = self.stop(&active, view.steps, ahead);
                self.active[key] = Some(active);
                true
            }
            Ok(ControlFlow::Break(end)) => self.end(key, &active, view, Ok(end)),
            Err(error) => self.end(key, &active, view, Err(error)),
        }
    }

    fn pass(&mut self, key: usize, view: &View<'_, f64, S>, signs_kept: bool) -> bool {
        let Some(mut active) = self.active[key].take() else {
            return false;
        };
        let passed = guard(|| match active.observer.pass(view, signs_kept) {
            ControlFlow::Continue(()) => Ok(None),
            ControlFlow::Break(()) => {
                let end = active.observer.end()?.unwrap_or(view.state).clone();
                self.write(&mut active, view, &end, true);
                Ok(Some((end, true)))
            }
        });
        match passed.and_then(|passed| passed) {
            Ok(None) => {
                self.active[key] = Some(active);
                true
            }
            Ok(Some(end)) => self.end(key, &active, view, Ok(end)),
            Err(error) => self.end(key, &active, view, Err(error)),
        }
    }

    fn take_drifts(
        &mut self,
        key: usize,
        system: &Description,
        followed: &mut FollowedQuantities<f64>,
    ) {
        if let Some(active) = &mut self.active[key] {
            FollowVisitor::write_back(system, followed, |visitor| active.observer.follow(visitor));
        }
    }

    fn phase(&self) -> u64 {
        0
    }

    fn leave(&mut self, _: &mut MemberRun<f64, S>) {}

    fn fail(&mut self, run: &mut MemberRun<f64, S>, error: Error) {
        let values = self.active[run.key].take().map(|active| active.values);
        let time = run.clock.at(run.made);
        let status = Status::of(&error, true);
        self.finish(
            run.key,
            status,
            time,
            run.made,
            &values.unwrap_or_default(),
            Some(error),
        );
    }

    fn observes(&self) -> bool {
        true
    }

    fn is_cancelled(&mut self) -> bool {
        self.cancelled |= self.sweep.is_cancelled();
        self.cancelled
    }
}
