//! Lyapunov exponents of many starts.
//!
//! Input: a system and a start for each index, a scheme, a step. Output: the exponents of each. Invariants:
//! each deviation of a member is a run over dual numbers, in lanes beside others; what is done to deviations
//! between blocks is what [`Tangent`](crate::tangents::Tangent) does, in the same order.

use super::Member;
use super::bound::Ensembles;
use super::guard::guard;
use super::ordered::in_order;
use super::seat::{Host, Seat};
use super::threads;
use crate::error::Error;
use crate::integrator::{check_start, check_step, duration};
use crate::map::Clock;
use crate::observe::{Follows, View};
use crate::state::State;
use crate::system::System;
use crate::tangent::{check_deviations, gram_schmidt, lifted, towards};
use crate::vector::Vector;
use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;
use core::fmt;
use core::ops::{ControlFlow, Range};
use core::sync::atomic::{AtomicBool, Ordering};
use hamiltonian_lanes::{Dual, Real};
use nalgebra::DMatrix;

/// A number and its derivative.
type D = Dual<f64>;
/// Makes the system and the start of a member.
type Make<'a, S> =
    Box<dyn Fn(Member) -> Result<(S, State<<S as System<f64>>::Vector>), Error> + Send + Sync + 'a>;

/// The Lyapunov exponents of many starts, in the lanes of packs and on threads: maps of chaos.
///
/// They are those of [`Tangent::lyapunov`](crate::tangents::Tangent::lyapunov) for each member: mean rates of growth
/// of deviations over a finite stretch, in units of 1/time. Each deviation is carried by a run over
/// [`Dual`](crate::Dual)s.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
///
/// let start = |member: Member| (Oscillator {}, State::new([0.1 * member.index as f64], [0.5]));
/// let all = Lyapunov::new(20, start, ImplicitMidpoint::default(), 0.1)
///     .deviations(2)
///     .steps(1_000)
///     .collect()?;
/// for exponents in all {
///     // Neighbours of an oscillator stay where they are.
///     assert!(exponents?.iter().all(|rate| rate.abs() < 1e-3));
/// }
/// # Ok::<(), Error>(())
/// ```
///
/// # Bits
/// As for an [`Ensemble`](crate::Ensemble): threads and the other members change no bit, and with
/// [`reproducible`](Lyapunov::reproducible) each has the bits of a single
/// [`Tangent`](crate::tangents::Tangent) on every CPU.
pub struct Lyapunov<'a, S: System<f64>, M> {
    count: usize,
    make: Make<'a, S>,
    scheme: M,
    step: f64,
    steps: u64,
    every: u64,
    deviations: usize,
    threads: usize,
    fuses: bool,
    cancel: Option<&'a AtomicBool>,
    progress: Option<Box<dyn Fn(usize, usize) + Send + Sync + 'a>>,
}

impl<'a, S: System<f64> + System<D>, M: Ensembles<S, D>> Lyapunov<'a, S, M> {
    /// The exponents of `count` members with the step `step`, to be given a number of
    /// [`steps`](Lyapunov::steps). `make` makes the system and the start of a member, on any thread.
    pub fn new(
        count: usize,
        make: impl Fn(Member) -> (S, State<<S as System<f64>>::Vector>) + Send + Sync + 'a,
        scheme: M,
        step: f64,
    ) -> Self {
        Self::try_new(count, move |member| Ok(make(member)), scheme, step)
    }

    /// The same with a closure that returns a `Result`, the error of which is that of the member.
    pub fn try_new(
        count: usize,
        make: impl Fn(Member) -> Result<(S, State<<S as System<f64>>::Vector>), Error>
        + Send
        + Sync
        + 'a,
        scheme: M,
        step: f64,
    ) -> Self {
        Lyapunov {
            count,
            make: Box::new(make),
            scheme,
            step,
            steps: 0,
            every: 10,
            deviations: 1,
            threads: threads::available(),
            fuses: true,
            cancel: None,
            progress: None,
        }
    }

    /// Sets the number of steps of which the rates are means.
    #[must_use]
    pub fn steps(mut self, n: u64) -> Self {
        self.steps = n;
        self
    }

    /// Makes deviations orthonormal after so many steps (0 counts as 1); by default after 10. Every time unit
    /// or so is often enough.
    #[must_use]
    pub fn every(mut self, steps: u64) -> Self {
        self.every = steps.max(1);
        self
    }

    /// Sets the number of exponents, the greatest first; by default it is 1. The rates of k deviations are
    /// the first k of more.
    #[must_use]
    pub fn deviations(mut self, k: usize) -> Self {
        self.deviations = k;
        self
    }

    /// Runs on so many threads (0 counts as 1). By default there are as many as the machine runs at once.
    #[must_use]
    pub fn threads(mut self, threads: usize) -> Self {
        self.threads = threads.max(1);
        self
    }

    /// Fuses no products and sums, so that each member has the bits of its single
    /// [`Tangent`](crate::tangents::Tangent) on every CPU.
    #[must_use]
    pub fn reproducible(mut self) -> Self {
        self.fuses = false;
        self
    }

    /// Stops with [`Error::Cancelled`] once the flag is set, for example by a handler of Ctrl-C.
    #[must_use]
    pub fn cancel(mut self, flag: &'a AtomicBool) -> Self {
        self.cancel = Some(flag);
        self
    }

    /// Calls a closure now and then with the number of members that are done and of all.
    #[must_use]
    pub fn progress(mut self, closure: impl Fn(usize, usize) + Send + Sync + 'a) -> Self {
        self.progress = Some(Box::new(closure));
        self
    }

    /// The exponents of each member, or its error, in the order of the index.
    ///
    /// # Errors
    /// [`Error::NoMembers`], [`Error::NoSteps`], [`Error::Step`], [`Error::Cancelled`]. The error of a
    /// member is [`Error::Member`] in its place: of its start, [`Error::Deviations`], of its steps.
    pub fn collect(&self) -> Result<Vec<Result<Vec<f64>, Error>>, Error> {
        /// The most members that are computed at once, by one thread.
        const CHUNK: usize = 640;
        if self.count == 0 {
            return Err(Error::NoMembers);
        }
        if self.steps == 0 {
            return Err(Error::NoSteps);
        }
        check_step(self.step)?;
        let size = self.count.div_ceil(64).clamp(80, CHUNK);
        let chunk = |job: usize| {
            let first = job * size;
            self.chunk(first..self.count.min(first + size))
        };
        let mut all = Vec::with_capacity(self.count);
        let mut result = Ok(());
        in_order(self.count.div_ceil(size), self.threads, chunk, |_, some| {
            let Some(some) = some else {
                result = Err(Error::Cancelled {
                    done: all.len(),
                    of: self.count,
                });
                return ControlFlow::Break(());
            };
            all.extend(some);
            if let Some(progress) = &self.progress {
                progress(all.len(), self.count);
            }
            ControlFlow::Continue(())
        });
        result.map(|()| all)
    }

    /// The exponents of some members; `None` if the flag is set.
    fn chunk(&self, indices: Range<usize>) -> Option<Vec<Result<Vec<f64>, Error>>> {
        let mut members: Vec<Deviated<S>> = Vec::with_capacity(indices.len());
        for index in indices.clone() {
            let first = members.iter().find(|member| member.failure.is_none());
            let made = self.begin(index, first.and_then(|first| first.prepared.as_ref()));
            members.push(made.unwrap_or_else(|error| Deviated::failed(error)));
        }
        let mut made = 0;
        while made < self.steps {
            if self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
                return None;
            }
            let target = made.saturating_add(self.every).min(self.steps);
            let mut round = Round {
                members: &mut members,
                deviations: self.deviations,
                step: self.step,
                interval: self.step * duration::<f64>(&self.scheme.entry()),
                made,
                target,
                next: 0,
                equals: |a: &_, b: &_| Ensembles::<S, D>::equals(&self.scheme, a, b),
            };
            Ensembles::<S, D>::drive(&self.scheme, &mut round, self.fuses);
            made = target;
            for member in &mut members {
                let Deviated { sums, failure, .. } = member;
                if failure.is_some() {
                    continue;
                }
                // `sums` is moved out while the member's deviations change.
                let mut sums = core::mem::take(sums);
                for (sum, grown) in sums.iter_mut().zip(member.orthonormalise()) {
                    *sum += Real::ln(grown);
                }
                member.sums = sums;
            }
        }
        let exponents = members.into_iter().zip(indices).map(|(member, index)| {
            let time = member.time - member.begin;
            match member.failure {
                None => Ok(member.sums.into_iter().map(|sum| sum / time).collect()),
                Some((_, error)) => Err(Error::Member {
                    index,
                    error: Box::new(error),
                }),
            }
        });
        Some(exponents.collect())
    }

    /// A member at its start, which fits the one before.
    fn begin(
        &self,
        index: usize,
        other: Option<&<S as System<D>>::Prepared>,
    ) -> Result<Deviated<S>, Error> {
        let (system, start) = guard(|| (self.make)(Member::new(index, 0))).and_then(|made| made)?;
        let lifted = lifted::<f64, S>(&system, &start)?;
        check_deviations(self.deviations, lifted.q.len())?;
        let prepared = check_start::<D, S>(&system, &lifted)?;
        if other.is_some_and(|other| !Ensembles::<S, D>::fits(&self.scheme, other, &prepared)) {
            let system = <S as System<f64>>::NAME;
            return Err(Error::OtherSizes { system });
        }
        let mut words = Vec::new();
        let mut matrix = DMatrix::zeros(2 * lifted.q.len(), self.deviations);
        for deviation in 0..self.deviations {
            let start = towards(&lifted, deviation);
            self.scheme.check(&prepared, &start)?;
            let carried = self.scheme.start(&prepared, &start, Dual::fixed(self.step));
            words.push(carried.components().collect());
            matrix[(deviation, deviation)] = 1.0;
        }
        let mut member = Deviated {
            prepared: Some(prepared),
            words,
            matrix,
            sums: vec![0.0; self.deviations],
            begin: start.t,
            time: start.t,
            state: Some(lifted),
            failure: None,
        };
        member.orthonormalise();
        Ok(member)
    }
}

/// A member with its deviations.
struct Deviated<S: System<D>> {
    /// None for a member that could not start; the same for `state`.
    prepared: Option<S::Prepared>,
    /// All that the scheme carries, deviation by deviation.
    words: Vec<Vec<D>>,
    /// The deviations, one a column.
    matrix: DMatrix<f64>,
    /// Sums of the logarithms of their growth.
    sums: Vec<f64>,
    /// The time at its start, and now.
    begin: f64,
    time: f64,
    /// A state of its shape.
    state: Option<State<S::Vector>>,
    /// Its error, and the deviation that had it.
    failure: Option<(usize, Error)>,
}

impl<S: System<D>> Deviated<S> {
    fn failed(error: Error) -> Self {
        Deviated {
            prepared: None,
            words: Vec::new(),
            matrix: DMatrix::zeros(0, 0),
            sums: Vec::new(),
            begin: 0.0,
            time: 0.0,
            state: None,
            failure: Some((0, error)),
        }
    }

    /// Replaces the deviations by orthonormal ones of the same span, in all that is carried. Returns what
    /// each had grown to.
    fn orthonormalise(&mut self) -> Vec<f64> {
        let words = &mut self.words;
        let grown = gram_schmidt(&mut self.matrix, |to, scale, less| {
            let other = less.map(|(from, along)| (words[from].clone(), along));
            for (index, word) in words[to].iter_mut().enumerate() {
                word.eps *= scale;
                if let Some((from, along)) = &other {
                    word.eps -= *along * from[index].eps;
                }
            }
        });
        if let Some((first, others)) = words.split_first_mut() {
            for other in others {
                for (word, first) in other.iter_mut().zip(&*first) {
                    word.re = first.re;
                }
            }
        }
        grown
    }
}

/// The deviations of the members on their way from one number of steps to another.
struct Round<'r, S: System<D>, E> {
    members: &'r mut [Deviated<S>],
    deviations: usize,
    step: f64,
    /// The time of one step.
    interval: f64,
    made: u64,
    target: u64,
    /// The next deviation of all.
    next: usize,
    /// Whether two systems have equal parameters.
    equals: E,
}

impl<S, E> Host<D, S> for Round<'_, S, E>
where
    S: System<D>,
    E: Fn(&S::Prepared, &S::Prepared) -> bool,
{
    fn load(&mut self, seat: &mut Option<Seat<D, S>>) -> bool {
        loop {
            let key = self.next;
            let Some(member) = self.members.get(key / self.deviations) else {
                return false;
            };
            self.next += 1;
            let (None, Some(prepared), Some(state)) =
                (&member.failure, &member.prepared, &member.state)
            else {
                continue;
            };
            let words = &member.words[key % self.deviations];
            let clock = Clock {
                start: Dual::fixed(member.begin),
                interval: Dual::fixed(self.interval),
            };
            match seat {
                Some(seat) => {
                    if !(self.equals)(&seat.prepared, prepared) {
                        seat.prepared.clone_from(prepared);
                        seat.other = true;
                    }
                    seat.words.copy_from_slice(words);
                    (seat.key, seat.clock) = (key, clock);
                    (seat.made, seat.stop, seat.since) = (self.made, self.target, self.made);
                }
                None => {
                    *seat = Some(Seat {
                        key,
                        prepared: prepared.clone(),
                        other: true,
                        step: Dual::fixed(self.step),
                        clock,
                        made: self.made,
                        stop: self.target,
                        words: words.clone(),
                        follows: Follows::default(),
                        interval: u64::MAX,
                        since: self.made,
                        seen: self.made,
                        state: state.clone(),
                    });
                }
            }
            return true;
        }
    }

    fn arrive(
        &mut self,
        key: usize,
        _: &mut u64,
        _: &mut Follows<D>,
        view: &View<'_, D, S>,
    ) -> bool {
        let deviation = key % self.deviations;
        let member = &mut self.members[key / self.deviations];
        let State { t, q, p } = view.state;
        let mut column = member.matrix.column_mut(deviation);
        for (to, from) in column.iter_mut().zip(q.components().chain(p.components())) {
            *to = from.eps;
        }
        if deviation == 0 {
            member.time = t.re;
        }
        false
    }

    fn pass(&mut self, _: usize, _: &View<'_, D, S>, _: bool) -> bool {
        true
    }

    fn follow(&mut self, _: usize, _: &mut Follows<D>) {}

    fn phase(&self) -> u64 {
        0
    }

    fn leave(&mut self, seat: &mut Seat<D, S>) {
        let member = &mut self.members[seat.key / self.deviations];
        member.words[seat.key % self.deviations].copy_from_slice(&seat.words);
    }

    fn fail(&mut self, seat: &mut Seat<D, S>, error: Error) {
        let deviation = seat.key % self.deviations;
        let failure = &mut self.members[seat.key / self.deviations].failure;
        if failure.as_ref().is_none_or(|(of, _)| deviation < *of) {
            *failure = Some((deviation, error));
        }
    }

    fn looks(&self) -> bool {
        true
    }
}

impl<S: System<f64>, M: fmt::Debug> fmt::Debug for Lyapunov<'_, S, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Lyapunov")
            .field("system", &S::NAME)
            .field("scheme", &self.scheme)
            .field("members", &self.count)
            .field("step", &self.step)
            .field("steps", &self.steps)
            .field("deviations", &self.deviations)
            .finish_non_exhaustive()
    }
}
