//! Members in memory, in chunks of some hundreds.
//!
//! Input: systems and starts. Output: the members after a number of steps. Invariant: a chunk stores the
//! carried values of the scheme, the parameters (once, if all are equal) and one observer per member. Nothing
//! else in it grows with the number of members.

use super::guard::guard;
use super::host::{Host, MemberRun, RunAtStop};
use crate::errors::Error;
use crate::flows::map::Clock;
use crate::observers::observe::{FollowVisitor, FollowedQuantities, Observer, View};
use crate::systems::state::State;
use crate::systems::system::{Description, Dynamics, System, VectorOf};
use crate::systems::vector::Vector;
use alloc::boxed::Box;
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use core::ops::ControlFlow;

/// A value that all members share, or one value per member.
#[derive(Debug, Clone)]
pub(crate) enum Shared<A> {
    /// No member has one.
    Nothing,
    One(A),
    Each(Vec<A>),
}

impl<A: Clone> Shared<A> {
    pub(crate) fn get(&self, index: usize) -> Option<&A> {
        match self {
            Shared::Nothing => None,
            Shared::One(one) => Some(one),
            Shared::Each(each) => each.get(index),
        }
    }

    /// The value of the first member that has one.
    pub(crate) fn first(&self) -> Option<&A> {
        match self {
            Shared::Nothing => None,
            Shared::One(one) => Some(one),
            Shared::Each(each) => each.first(),
        }
    }

    /// Adds the value of member `count`, if it has one.
    fn push(&mut self, count: usize, value: Option<A>, equals: impl Fn(&A, &A) -> bool) {
        match (&mut *self, value) {
            (Shared::Nothing, Some(value)) => *self = Shared::One(value),
            (Shared::One(one), Some(value)) if !equals(one, &value) => {
                let mut each = alloc::vec![one.clone(); count];
                each.push(value);
                *self = Shared::Each(each);
            }
            (Shared::Each(each), Some(value)) => each.push(value),
            // A member without a value has failed: its entry is never read.
            (Shared::Each(each), None) => each.extend(each.first().cloned()),
            _ => {}
        }
    }
}

/// The outcome of a member that has stopped.
#[derive(Debug, Clone)]
pub(crate) enum Finished<V: Vector> {
    /// The error of the member, and the number of steps made before it.
    Failed(Error, u64),
    /// The state at which its observer ended the member, and the number of steps made.
    Ended(Box<State<V>>, u64),
}

/// Members with consecutive indices.
#[derive(Debug, Clone)]
pub(crate) struct Chunk<R, V: Vector<Scalar = f64>, O> {
    /// The index of the first member.
    pub(crate) first: usize,
    pub(crate) count: usize,
    /// The carried values of the scheme, member by member.
    pub(crate) words: Vec<f64>,
    pub(crate) prepared: Shared<R>,
    /// The times at which the members start.
    pub(crate) starts: Shared<f64>,
    /// The number of steps after which the scheme started, for each member; empty if it is 0 for all.
    pub(crate) began: Vec<u64>,
    /// The number of steps that each member has made; empty if all have made as many.
    pub(crate) steps: Vec<u64>,
    pub(crate) finished: BTreeMap<usize, Finished<V>>,
    pub(crate) observers: Vec<O>,
}

/// A chunk of members of `S`.
pub(crate) type ChunkOf<S, O> = Chunk<<S as System>::Prepared<f64>, VectorOf<S>, O>;

impl<R: Clone, V: Vector<Scalar = f64>> Chunk<R, V, ()> {
    pub(crate) fn new(first: usize) -> Self {
        Chunk {
            first,
            count: 0,
            words: Vec::new(),
            prepared: Shared::Nothing,
            starts: Shared::Nothing,
            began: Vec::new(),
            steps: Vec::new(),
            finished: BTreeMap::new(),
            observers: Vec::new(),
        }
    }

    /// Adds a member, whose carried value is already at the end of `words`, or its error.
    pub(crate) fn push(
        &mut self,
        member: Result<(R, f64), Error>,
        equals: impl Fn(&R, &R) -> bool,
    ) {
        let (prepared, start) = match member {
            Ok((prepared, start)) => (Some(prepared), Some(start)),
            Err(error) => {
                self.finished.insert(self.count, Finished::Failed(error, 0));
                (None, None)
            }
        };
        self.prepared.push(self.count, prepared, equals);
        let same_bits = |a: &f64, b: &f64| a.to_bits() == b.to_bits();
        self.starts.push(self.count, start, same_bits);
        self.observers.push(());
        self.count += 1;
    }

    /// Releases the memory reserved for further members.
    pub(crate) fn shrink(&mut self) {
        self.words.shrink_to_fit();
        if let Shared::Each(prepared) = &mut self.prepared {
            prepared.shrink_to_fit();
        }
        if let Shared::Each(starts) = &mut self.starts {
            starts.shrink_to_fit();
        }
    }
}

impl<R: Clone, V: Vector<Scalar = f64>, O> Chunk<R, V, O> {
    /// Replaces the observers of the members.
    pub(crate) fn with_observers<N>(self, observers: Vec<N>) -> Chunk<R, V, N> {
        Chunk {
            first: self.first,
            count: self.count,
            words: self.words,
            prepared: self.prepared,
            starts: self.starts,
            began: self.began,
            steps: self.steps,
            finished: self.finished,
            observers,
        }
    }
}

impl<R: Clone, V: Vector<Scalar = f64>, O> Chunk<R, V, O> {
    /// Returns the number of steps that a member has made, which is that of `common` unless members differ.
    pub(crate) fn made(&self, key: usize, common: &Common<V>) -> u64 {
        self.steps.get(key).copied().unwrap_or(common.steps)
    }

    /// Returns a copy of the members before `end`, without observers.
    pub(crate) fn unobserved(&self, end: usize, width: usize) -> Chunk<R, V, ()> {
        Chunk {
            first: self.first,
            count: end,
            words: self.words[..end * width].into(),
            prepared: self.prepared.clone(),
            starts: self.starts.clone(),
            began: self.began.clone(),
            steps: self.steps.clone(),
            finished: self.finished.clone(),
            observers: alloc::vec![(); end],
        }
    }
}

/// Properties common to all members of an ensemble.
#[derive(Debug, Clone)]
pub(crate) struct Common<V: Vector<Scalar = f64>> {
    /// A state of their shape.
    pub(crate) template: Option<State<V>>,
    /// The number of words that a member carries.
    pub(crate) width: usize,
    pub(crate) step: f64,
    /// The duration of one step.
    pub(crate) interval: f64,
    /// True if steps differ in duration.
    pub(crate) varies: bool,
    /// The number of steps made by the members that have not stopped; the largest of these numbers if they differ.
    pub(crate) steps: u64,
}

/// The host of a chunk, whose members advance from one number of steps to another. At each stop, `receive` is called
/// with the member's observer and its view. It ends the member by returning `Break`.
pub(crate) struct ChunkHost<'a, S: System, O, F> {
    pub(crate) chunk: &'a mut ChunkOf<S, O>,
    pub(crate) common: &'a Common<VectorOf<S>>,
    /// The number of steps after which members leave their lanes.
    pub(crate) left: u64,
    /// True if observers receive states.
    pub(crate) observes: bool,
    /// The index of the next member.
    pub(crate) next: usize,
    /// True if observers receive their first state.
    pub(crate) attaches: bool,
    /// True if the lanes evaluate the quantities that observers follow.
    pub(crate) evaluates_in_lanes: bool,
    pub(crate) receive: F,
}

/// The state at which an observer has ended a member; `None` for the state that it received.
type EndOf<S> = Result<Option<State<VectorOf<S>>>, Error>;

/// The verdict of an observer on a view: `Break` with the final state if the member ends.
pub(crate) type Decision<S> = ControlFlow<EndOf<S>>;

/// Returns the state at which the observer ends its member, see [`EndOf`].
pub(crate) fn end_of<S: System, O: Observer<f64, S>>(observer: &O) -> EndOf<S> {
    observer.end().map(Option::<&_>::cloned)
}

impl<S, O, F> ChunkHost<'_, S, O, F>
where
    S: System,
    O: Observer<f64, S>,
{
    /// Returns the number of steps at which a member leaves its lane.
    fn target(&self, key: usize) -> u64 {
        self.chunk.made(key, self.common).saturating_add(self.left)
    }

    /// Returns the next stop of a member that has made `made` steps.
    pub(crate) fn stop(&self, key: usize, made: u64) -> u64 {
        if !self.observes {
            return self.target(key);
        }
        let interval = self.chunk.observers[key].interval().max(1);
        let due = (made / interval).saturating_add(1).saturating_mul(interval);
        due.min(self.target(key))
    }

    /// Records the state at which a member has ended. Returns false: the member does not stay.
    pub(crate) fn end(&mut self, key: usize, view: &View<'_, f64, S>, end: EndOf<S>) -> bool {
        let finished = match end {
            Ok(end) => {
                let end = end.unwrap_or_else(|| view.state.clone());
                Finished::Ended(Box::new(end), view.steps)
            }
            Err(error) => Finished::Failed(error, view.steps),
        };
        self.chunk.finished.insert(key, finished);
        false
    }

    /// Lists the quantities that lanes evaluate for a member whose observer receives states. The list is empty unless
    /// lanes can evaluate everything that the observer needs.
    fn list_followed(&mut self, key: usize, into: &mut FollowedQuantities<f64>) {
        let Some(prepared) = self.chunk.prepared.get(key) else {
            return;
        };
        let observer = &mut self.chunk.observers[key];
        // In lanes, observers receive states after the same steps.
        let evaluates = self.evaluates_in_lanes && self.chunk.steps.is_empty();
        FollowVisitor::list(prepared.description(), into, |visitor| {
            evaluates && observer.follow(visitor)
        });
        // An observer without its first state has no previous values of the functions whose sign it follows.
        if self.attaches && !into.sections.is_empty() {
            *into = FollowedQuantities::default();
        }
        if self.attaches {
            into.drifts.iter_mut().for_each(|track| track.drift = None);
        }
    }
}

impl<S, O, F> Host<f64, S> for ChunkHost<'_, S, O, F>
where
    S: System,
    O: Observer<f64, S>,
    F: FnMut(usize, &mut O, &View<'_, f64, S>) -> Decision<S>,
{
    fn load(&mut self, slot: &mut Option<MemberRun<f64, S>>) -> bool {
        while self.next < self.chunk.count && self.chunk.finished.contains_key(&self.next) {
            self.next += 1;
        }
        let key = self.next;
        if key >= self.chunk.count {
            return false;
        }
        self.next += 1;
        // Reuses the storage of the previous run.
        let mut followed = FollowedQuantities::default();
        if self.observes {
            if let Some(run) = slot {
                core::mem::swap(&mut run.followed, &mut followed);
            }
            self.list_followed(key, &mut followed);
        }
        let (Some(prepared), Some(start), Some(template)) = (
            self.chunk.prepared.get(key),
            self.chunk.starts.get(key),
            &self.common.template,
        ) else {
            return false;
        };
        let made = self.chunk.made(key, self.common);
        let began = self.chunk.began.get(key).copied().unwrap_or(0);
        let interval = self.chunk.observers[key].interval();
        let stop = match followed.is_empty() {
            true => self.stop(key, made),
            false => self.target(key),
        };
        let width = self.common.width;
        let words = &self.chunk.words[key * width..][..width];
        let clock = Clock::new(*start, self.common.interval);
        match slot {
            Some(run) => {
                if matches!(self.chunk.prepared, Shared::Each(_)) {
                    run.prepared.clone_from(prepared);
                    run.system_changed = true;
                }
                run.words.copy_from_slice(words);
                (run.key, run.clock, run.made, run.stop) = (key, clock, made, stop);
                run.began = began;
                (run.followed, run.interval) = (followed, interval);
                (run.since, run.received) = (made, made);
            }
            None => {
                *slot = Some(MemberRun {
                    key,
                    prepared: prepared.clone(),
                    system_changed: true,
                    step: self.common.step,
                    clock,
                    made,
                    began,
                    stop,
                    words: words.into(),
                    followed,
                    interval,
                    since: made,
                    received: made,
                    state: template.clone(),
                });
            }
        }
        true
    }

    fn receive(&mut self, key: usize, run: RunAtStop<'_, f64>, view: &View<'_, f64, S>) -> bool {
        // The lanes have evaluated the quantities of its observer up to the target.
        if !run.followed.is_empty() {
            return false;
        }
        let observer = &mut self.chunk.observers[key];
        let receive = &mut self.receive;
        match guard(|| receive(key, observer, view)) {
            Ok(ControlFlow::Continue(())) => {
                *run.stop = self.stop(key, view.steps);
                view.steps < self.target(key)
            }
            Ok(ControlFlow::Break(end)) => self.end(key, view, end),
            Err(error) => self.end(key, view, Err(error)),
        }
    }

    fn pass(&mut self, key: usize, view: &View<'_, f64, S>, signs_kept: bool) -> bool {
        let observer = &mut self.chunk.observers[key];
        let passed = guard(|| match observer.pass(view, signs_kept) {
            ControlFlow::Continue(()) => ControlFlow::Continue(()),
            ControlFlow::Break(()) => ControlFlow::Break(end_of(observer)),
        });
        match passed {
            Ok(ControlFlow::Continue(())) => true,
            Ok(ControlFlow::Break(end)) => self.end(key, view, end),
            Err(error) => self.end(key, view, Err(error)),
        }
    }

    fn take_drifts(
        &mut self,
        key: usize,
        system: &Description,
        followed: &mut FollowedQuantities<f64>,
    ) {
        let observer = &mut self.chunk.observers[key];
        FollowVisitor::write_back(system, followed, |visitor| observer.follow(visitor));
    }

    fn phase(&self) -> u64 {
        self.common.steps
    }

    fn leave(&mut self, run: &mut MemberRun<f64, S>) {
        let width = self.common.width;
        self.chunk.words[run.key * width..][..width].copy_from_slice(&run.words);
        if let Some(steps) = self.chunk.steps.get_mut(run.key) {
            *steps = run.made;
        }
    }

    fn fail(&mut self, run: &mut MemberRun<f64, S>, error: Error) {
        self.chunk
            .finished
            .insert(run.key, Finished::Failed(error, run.made));
        self.leave(run);
    }

    fn observes(&self) -> bool {
        self.observes
    }

    fn is_cancelled(&mut self) -> bool {
        false
    }
}

/// Passes a state to an observer if its number of steps is a multiple of the observer's interval.
pub(crate) fn observe<S: System, O: Observer<f64, S>>(
    observer: &mut O,
    view: &View<'_, f64, S>,
) -> Decision<S> {
    let is_due = view.steps.is_multiple_of(observer.interval().max(1));
    if !is_due || observer.observe(view).is_continue() {
        return ControlFlow::Continue(());
    }
    ControlFlow::Break(end_of(observer))
}
