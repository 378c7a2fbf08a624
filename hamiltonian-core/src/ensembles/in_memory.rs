//! Ensembles whose members stay in memory.
//!
//! Input: a system and a start for each index, a scheme, a step. Output: the members after a number of steps.

use super::Member;
use super::bound::{self, ErasedScheme};
use super::change::Standing;
use super::chunk::{Chunk, ChunkHost, ChunkOf, Common, Decision, Finished, end_of, observe};
use super::guard::guard;
use super::rounding::{Fused, Rounding, Unfused};
use super::threads;
use crate::errors::{Error, SweepError};
use crate::flows::map::Clock;
use crate::observers::observe::{Observer, Unobserved, Verdict, View};
use crate::results::checkpoint::Memory;
use crate::runs::integrator::{check_start, check_step, duration};
use crate::schemes::scheme::Scheme;
use crate::systems::state::State;
use crate::systems::system::{System, VectorOf};
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt;
use core::marker::PhantomData;
use core::ops::ControlFlow;

/// Integrates many members of one system with one scheme, and keeps their states in memory.
///
/// Each member has its own start and its own parameters. A member that fails keeps its error, and the others
/// continue. [`Sweep`](crate::Sweep) is for members of which only numbers at their ends, or at given times, are wanted:
/// its members need no memory.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
///
/// let mut swarm = Ensemble::new(1_000, |member| {
///     let theta = 3.0 * (member.index as f64 / 1e3 - 0.5);
///     (Oscillator {}, State::new([theta], [0.0]))
/// }, ImplicitMidpoint::default(), 1e-3)?;
/// swarm.advance(1_000);
/// for end in swarm.states() {
///     assert!((end?.t - 1.0).abs() < 1e-12);
/// }
/// # Ok::<(), Error>(())
/// ```
///
/// # Reproducibility
/// By default, results depend on the CPU, but not on the number of threads or on other members. Members are computed in
/// packs, a few CPU registers whose numbers, the lanes, belong to one member each. Products and sums are fused, `a·b + c`
/// rounded once, if the CPU has such instructions. A [`reproducible`](Ensemble::reproducible) ensemble does not fuse
/// them, and its members have the bits of a single [`Integrator`](crate::Integrator) on every CPU.
///
/// The rounding is a type, so that a program contains the code of the ensembles that it advances, and no other:
/// `Ensemble<S, M>` fuses, `Ensemble<S, M, (), Unfused>` is reproducible.
pub struct Ensemble<S: System, M, O = (), A = Fused> {
    pub(crate) scheme: Arc<M>,
    pub(crate) chunks: Vec<ChunkOf<S, O>>,
    pub(crate) common: Common<VectorOf<S>>,
    pub(super) threads: usize,
    rounding: PhantomData<A>,
    /// The saved data of observers, until they are attached to a resumed ensemble.
    pub(crate) memory: Memory,
}

/// A multiple of the lanes of every wide pack: 8, 16, 24 or 64.
const LANES: usize = 192;
/// The largest number of members in a chunk.
const CHUNK: usize = 10 * LANES;

impl<S: System, M: Scheme<S>> Ensemble<S, M> {
    /// Creates an ensemble of `count` members with the step size `step`, which is negative to integrate backwards. `make`
    /// makes the system and the start of each member.
    ///
    /// A member that cannot start has its error in [`states`](Ensemble::states): an invalid start, a panic of `make`
    /// ([`SweepError::Panicked`]), or a system of other sizes than the first ([`SweepError::OtherSizes`]).
    ///
    /// [`Member::seed`] is a seed for random numbers. For other seeds, write `Member::new(member.index, 1).seed`:
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// /// A number from 0 to 1; a generator of random numbers would be made from the seed here.
    /// fn random(seed: u64) -> f64 {
    ///     seed as f64 / u64::MAX as f64
    /// }
    /// let start = |member: Member| {
    ///     let other = Member::new(member.index, 1);
    ///     (Oscillator {}, State::new([random(member.seed)], [random(other.seed)]))
    /// };
    /// let swarm = Ensemble::new(1_000, start, ImplicitMidpoint::default(), 1e-3)?;
    /// let sum = swarm.states().try_fold(0.0, |sum, state| Ok::<_, Error>(sum + state?.q[0]))?;
    /// assert!((sum / 1e3 - 0.5).abs() < 0.05);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`SweepError::NoMembers`], [`StartError::Step`](crate::errors::StartError::Step).
    pub fn new(
        count: usize,
        mut make: impl FnMut(Member) -> (S, State<VectorOf<S>>),
        scheme: M,
        step: f64,
    ) -> Result<Self, Error> {
        Self::try_new(count, |member| Ok(make(member)), scheme, step)
    }

    /// Creates an ensemble as [`new`](Ensemble::new) does, with a closure that returns a `Result`. Its error becomes that
    /// of the member.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    /// use hamiltonian::analysis::{Branch, momentum_from_energy};
    ///
    /// // Starts of the energy 1/2. There are none at |q| > 1.
    /// let start = |member: Member| {
    ///     let guess = State::new([0.5 * member.index as f64], [0.0]);
    ///     let start = momentum_from_energy(&Oscillator {}, &guess, 0, 0.5, Branch::Forward)?;
    ///     Ok((Oscillator {}, start))
    /// };
    /// let swarm = Ensemble::try_new(4, start, ImplicitMidpoint::default(), 1e-3)?;
    /// assert!(swarm.state_of(1).is_some_and(|state| state.is_ok()));
    /// assert!(swarm.state_of(3).is_some_and(|state| state.is_err()));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`new`](Ensemble::new).
    pub fn try_new(
        count: usize,
        mut make: impl FnMut(Member) -> Result<(S, State<VectorOf<S>>), Error>,
        scheme: M,
        step: f64,
    ) -> Result<Self, Error> {
        if count == 0 {
            return Err(SweepError::NoMembers.into());
        }
        check_step(step)?;
        let of_type = Arc::new(scheme);
        let scheme: &dyn ErasedScheme<S> = &*of_type;
        let mut common = Common {
            template: None,
            width: 0,
            step,
            interval: step * duration::<f64>(&scheme.entry()),
            varies: false,
            steps: 0,
        };
        let mut first_of_all: Option<S::Prepared<f64>> = None;
        let size = count.div_ceil(64).next_multiple_of(LANES).min(CHUNK);
        let mut chunks = Vec::with_capacity(count.div_ceil(size));
        for first in (0..count).step_by(size) {
            let mut chunk = Chunk::new(first);
            for index in first..count.min(first + size) {
                // The words of a member that failed stay 0.
                chunk.words.resize((index - first) * common.width, 0.0);
                let made = guard(|| make(Member::new(index, 0))).and_then(|made| made);
                let begun = made.and_then(|(system, start)| {
                    let prepared = check_start(&system, &start)?;
                    if let Some(first) = &first_of_all
                        && !S::fits(first, &prepared)
                    {
                        let system = (*system.description().name).into();
                        return Err(SweepError::OtherSizes { system }.into());
                    }
                    scheme.begin(&prepared, &start, step, &mut chunk.words)?;
                    common.varies |= scheme.varies(&prepared, &start, step);
                    Ok((prepared, start))
                });
                let member = begun.map(|(prepared, start)| {
                    let t = start.t;
                    if first_of_all.is_none() {
                        first_of_all = Some(prepared.clone());
                        common.width = chunk.words.len();
                        let before = (index - first) * common.width;
                        chunk.words.splice(0..0, core::iter::repeat_n(0.0, before));
                        common.template = Some(start);
                    }
                    (prepared, t)
                });
                chunk.push(member, |a, b| S::equals(a, b));
            }
            chunk.words.resize(chunk.count * common.width, 0.0);
            chunk.words.shrink_to_fit();
            chunk.shrink();
            chunks.push(chunk);
        }
        Ok(Ensemble {
            scheme: of_type,
            chunks,
            common,
            threads: threads::available(),
            rounding: PhantomData,
            memory: Memory::default(),
        })
    }
}

impl<S: System, M: Scheme<S>, O: Observer<f64, S> + Send, A: Rounding> Ensemble<S, M, O, A> {
    /// Makes `n` steps of every member that has neither failed nor been ended by its observer.
    ///
    /// This returns no error: [`states`](Ensemble::states) has the error of a member in its place.
    pub fn advance(&mut self, n: u64) -> &mut Self {
        if n > 0 {
            self.drive(n, false, |_, observer, view| observe(observer, view));
            self.common.steps = self.common.steps.saturating_add(n);
        }
        self
    }

    /// Makes `n` steps, and calls a closure with the whole ensemble after every `every` steps (0 counts as 1) and at the
    /// end. The closure returns `()`, or a [`ControlFlow<()>`](ControlFlow) whose `Break` ends this call.
    ///
    /// The closure may draw pictures, report progress or check a condition on all members.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let start = |_| (Oscillator {}, State::new([0.1], [0.0]));
    /// let mut swarm = Ensemble::new(10, start, ImplicitMidpoint::default(), 1e-3)?;
    /// let mut seen = vec![];
    /// swarm.advance_watched(25, 10, |swarm| seen.push(swarm.steps()));
    /// assert_eq!(seen, [10, 20, 25]);
    /// # Ok::<(), Error>(())
    /// ```
    pub fn advance_watched<V: Verdict>(
        &mut self,
        n: u64,
        every: u64,
        mut closure: impl FnMut(&Self) -> V,
    ) {
        let mut left = n;
        while left > 0 {
            let some = every.max(1).min(left);
            self.advance(some);
            left -= some;
            if closure(self).control().is_break() {
                return;
            }
        }
    }
}

impl<S: System, M: Scheme<S>, O, A: Rounding> Ensemble<S, M, O, A> {
    /// The number of members.
    #[allow(clippy::len_without_is_empty)] // An ensemble has at least one member.
    pub fn len(&self) -> usize {
        self.chunks.iter().map(|chunk| chunk.count).sum()
    }

    /// The number of steps made by the members that have neither failed nor been ended. After
    /// [`advance_until`](Ensemble::advance_until) with steps that vary in time, the largest of these numbers.
    pub fn steps(&self) -> u64 {
        self.common.steps
    }

    /// The members' observers, in the order of the index.
    pub fn observers(&self) -> impl Iterator<Item = &O> {
        self.chunks.iter().flat_map(|chunk| &chunk.observers)
    }

    /// Returns the state of each member, in the order of the index: its current state, the one at which its observer
    /// ended it, or its error. Members do not advance.
    ///
    /// # Errors
    /// [`SweepError::Member`] with the index and the error of the member.
    pub fn states(&self) -> impl Iterator<Item = Result<State<VectorOf<S>>, Error>> {
        (0..self.chunks.len()).flat_map(|number| self.closed(number, 0..usize::MAX, None))
    }

    /// Returns the state of one member, see [`states`](Ensemble::states); `None` if there is no such index. Each call
    /// computes it from the carried value of the scheme.
    ///
    /// # Errors
    /// [`SweepError::Member`] with the index and the error of the member.
    pub fn state_of(&self, index: usize) -> Option<Result<State<VectorOf<S>>, Error>> {
        let number = self
            .chunks
            .partition_point(|chunk| chunk.first + chunk.count <= index);
        let key = index - self.chunks.get(number)?.first;
        self.closed(number, key..key + 1, None).pop()
    }

    /// The number of steps that one member has made; `None` if there is no such index.
    pub fn steps_of(&self, index: usize) -> Option<u64> {
        let number = self
            .chunks
            .partition_point(|chunk| chunk.first + chunk.count <= index);
        let chunk = self.chunks.get(number)?;
        Some(match chunk.finished.get(&(index - chunk.first)) {
            Some(Finished::Failed(_, steps) | Finished::Ended(_, steps)) => *steps,
            None => chunk.made(index - chunk.first, &self.common),
        })
    }
}

impl<S: System, M: Scheme<S>, O, A: Rounding> Ensemble<S, M, O, A> {
    /// Attaches an observer to each member, made from its index.
    ///
    /// An observer receives the current state at once, and from then on the states of its member as in a single run. An
    /// observer that ends its member ends no other.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let start = |member: Member| (Oscillator {}, State::new([0.1 * member.index as f64], [1.0]));
    /// let mut swarm = Ensemble::new(20, start, ImplicitMidpoint::default(), 1e-3)?
    ///     .observe(|_member| EnergyDrift::new());
    /// swarm.advance(1_000);
    /// assert!(swarm.observers().all(|drift| drift.max_relative() < 1e-6));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// Call `observe` once. For several observers, return a tuple.
    ///
    /// A member for which the closure panics fails with [`SweepError::Panicked`]. Its entry in
    /// [`observers`](Ensemble::observers) is an observer made for another member, which receives no states.
    pub fn observe<N: Observer<f64, S> + Send>(
        self,
        mut observer: impl FnMut(Member) -> N,
    ) -> Ensemble<S, M, N, A>
    where
        O: Unobserved,
    {
        let now = self.common.steps;
        let (mut of, count) = (
            |index| guard(|| observer(Member::new(index, 0))),
            self.len(),
        );
        // A member for which the closure does not panic, if any is known; and whether there is none.
        let (mut good, mut all_panic) = (None, false);
        let chunks = self.chunks.into_iter().map(|mut chunk| {
            let mut observers = Vec::with_capacity(chunk.count);
            for key in 0..chunk.count {
                let index = chunk.first + key;
                let made = of(index).or_else(|error| {
                    chunk
                        .finished
                        .entry(key)
                        .or_insert(Finished::Failed(error.clone(), now));
                    if good.is_none() && !all_panic {
                        good = (index + 1..count).find(|other| of(*other).is_ok());
                        all_panic = good.is_none();
                    }
                    good.map_or(Err(error), &mut of)
                });
                if good.is_none() && made.is_ok() {
                    good = Some(index);
                }
                observers.extend(made);
            }
            chunk.with_observers(observers)
        });
        let mut observed = Ensemble {
            scheme: self.scheme,
            chunks: chunks.collect(),
            common: self.common,
            threads: self.threads,
            rounding: PhantomData,
            memory: Memory::default(),
        };
        let mut memory = self.memory;
        if !memory.is_empty() {
            observed.restore(&mut memory);
            return observed;
        }
        observed.drive(0, true, |_, observer, view| match observer.attach(view) {
            ControlFlow::Continue(()) => ControlFlow::Continue(()),
            ControlFlow::Break(()) => ControlFlow::Break(end_of(observer)),
        });
        observed
    }
}

impl<S: System, M: Scheme<S>, O: Observer<f64, S> + Send, A: Rounding> Ensemble<S, M, O, A> {
    /// Changes the states of members between two steps, for example by kicks. The closure receives each member that has
    /// neither failed nor been ended, with its current state, whose time it must keep. It is called on this thread, in
    /// the order of the index.
    ///
    /// A member that is changed goes on as a single run after [`set_state`](crate::Integrator::set_state): its steps,
    /// times and observer stay. A member that is not changed keeps its bits. A state that cannot be a start is the error
    /// of its member. Parameters and the step size cannot be changed.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let start = |_| (Oscillator {}, State::new([0.1], [0.0]));
    /// let mut swarm = Ensemble::new(10, start, ImplicitMidpoint::default(), 1e-3)?;
    /// for _ in 0..5 {
    ///     swarm.advance(100);
    ///     swarm.update(|member, state| {
    ///         if member.index % 2 == 0 {
    ///             state.p[0] *= 0.9; // friction
    ///         }
    ///     });
    /// }
    /// assert_eq!(swarm.steps(), 500);
    /// # Ok::<(), Error>(())
    /// ```
    pub fn update(&mut self, mut change: impl FnMut(Member, &mut State<VectorOf<S>>)) -> &mut Self {
        let width = self.common.width;
        let scheme = Arc::clone(&self.scheme);
        let mut words = Vec::new();
        for number in 0..self.chunks.len() {
            let states = self.closed(number, 0..usize::MAX, None);
            let chunk = &mut self.chunks[number];
            for (key, state) in states.into_iter().enumerate() {
                let (Ok(state), Some(prepared), Some(start), false) = (
                    state,
                    chunk.prepared.get(key),
                    chunk.starts.get(key),
                    chunk.finished.contains_key(&key),
                ) else {
                    continue;
                };
                let made = chunk.made(key, &self.common);
                let standing = Standing {
                    scheme: &*scheme,
                    prepared,
                    step: self.common.step,
                    clock: Clock::new(*start, self.common.interval),
                    made,
                };
                let member = Member::new(chunk.first + key, 0);
                let closure = |state: &mut State<VectorOf<S>>| change(member, state);
                let observer = &mut chunk.observers[key];
                match standing.change(&state, closure, observer, &mut words) {
                    Ok(None) => {}
                    Ok(Some(_)) => {
                        chunk.words[key * width..][..width].copy_from_slice(&words);
                        chunk.began.resize(chunk.count, 0);
                        chunk.began[key] = made;
                    }
                    Err(error) => {
                        chunk.finished.insert(key, Finished::Failed(error, made));
                    }
                }
            }
        }
        self
    }
}

impl<S: System, M: Scheme<S>, O, A: Rounding> Ensemble<S, M, O, A> {
    /// Sets the number of threads (0 counts as 1). The default is the number that the machine runs at once. In a rayon
    /// pool, the ensemble has the threads of the pool.
    #[must_use]
    pub fn with_threads(mut self, threads: usize) -> Self {
        self.threads = threads.max(1);
        self
    }

    /// Turns fused products and sums off, so that each member has the bits of its single run on every CPU.
    #[must_use]
    pub fn reproducible(self) -> Ensemble<S, M, O, Unfused> {
        Ensemble {
            scheme: self.scheme,
            chunks: self.chunks,
            common: self.common,
            threads: self.threads,
            rounding: PhantomData,
            memory: self.memory,
        }
    }

    /// Returns the scheme without its type.
    pub(super) fn erased(&self) -> &dyn ErasedScheme<S> {
        &*self.scheme
    }

    /// Returns states of some members of a chunk: the current ones, or those at a time less than a step later.
    pub(super) fn closed(
        &self,
        number: usize,
        keys: core::ops::Range<usize>,
        t: Option<f64>,
    ) -> Vec<Result<State<VectorOf<S>>, Error>> {
        let chunk = &self.chunks[number];
        let keys = keys.start..keys.end.min(chunk.count);
        let mut states: Vec<Option<Result<State<VectorOf<S>>, Error>>> =
            alloc::vec![None; chunk.count];
        let mut copy = chunk.unobserved(keys.end, self.common.width);
        let mut host = ChunkHost {
            chunk: &mut copy,
            common: &self.common,
            left: 0,
            observes: true,
            attaches: false,
            evaluates_in_lanes: false,
            next: keys.start,
            receive: |key: usize, (): &mut (), view: &View<'_, f64, S>| {
                states[key] = Some(match t {
                    Some(t) => view.state_at(t),
                    None => Ok(view.state.clone()),
                });
                ControlFlow::Continue(())
            },
        };
        let scheme = &*self.scheme;
        threads::for_each(core::slice::from_mut(&mut host), 1, |host| {
            bound::drive::<f64, S, M, O, A>(scheme, host);
        });
        let member = |key: usize, error: Error| SweepError::member(chunk.first + key, error);
        keys.map(|key| match (chunk.finished.get(&key), states[key].take()) {
            (Some(Finished::Failed(error, _)), _) => Err(member(key, error.clone())),
            (Some(Finished::Ended(state, _)), _) => Ok((**state).clone()),
            (None, Some(state)) => state.map_err(|error| member(key, error)),
            (None, None) => Err(SweepError::NoMembers.into()),
        })
        .collect()
    }

    /// Restores the data of observers. A member fails if another observer saved its data.
    fn restore(&mut self, memory: &mut Memory)
    where
        O: Observer<f64, S> + Send,
    {
        for chunk in &mut self.chunks {
            // Members that have ended are loaded too, since their observers have saved data. Restoring takes a view,
            // from which an observer reads the shape of states.
            let finished = core::mem::take(&mut chunk.finished);
            for (key, one) in &finished {
                if let Finished::Failed(..) = one {
                    // One by one: to collect them would sort them, and the code that sorts is long.
                    chunk.finished.insert(*key, one.clone());
                }
            }
            let mut host = ChunkHost {
                chunk,
                common: &self.common,
                left: 0,
                observes: true,
                attaches: false,
                evaluates_in_lanes: false,
                next: 0,
                receive: |_: usize, observer: &mut O, view: &View<'_, f64, S>| match observer
                    .restore(view, memory)
                {
                    Ok(()) => ControlFlow::Continue(()),
                    Err(error) => ControlFlow::Break(Err(error)),
                },
            };
            let scheme = &*self.scheme;
            threads::for_each(core::slice::from_mut(&mut host), 1, |host| {
                bound::drive::<f64, S, M, O, A>(scheme, host);
            });
            chunk.finished.extend(finished);
        }
    }

    /// Makes so many steps of all members.
    fn drive(
        &mut self,
        left: u64,
        attaches: bool,
        receive: impl Fn(usize, &mut O, &View<'_, f64, S>) -> Decision<S> + Sync,
    ) where
        O: Observer<f64, S> + Send,
    {
        let (scheme, common) = (&*self.scheme, &self.common);
        threads::for_each(&mut self.chunks, self.threads, |chunk| {
            let observes = attaches || chunk.observers.iter().any(|one| one.interval() < u64::MAX);
            let mut host = ChunkHost {
                chunk,
                common,
                left,
                observes,
                attaches,
                evaluates_in_lanes: true,
                next: 0,
                receive: &receive,
            };
            bound::drive::<f64, S, M, O, A>(scheme, &mut host);
        });
    }
}

impl<S: System, M, O: Clone, A> Clone for Ensemble<S, M, O, A> {
    fn clone(&self) -> Self {
        Ensemble {
            scheme: Arc::clone(&self.scheme),
            chunks: self.chunks.clone(),
            common: self.common.clone(),
            threads: self.threads,
            rounding: PhantomData,
            memory: self.memory.clone(),
        }
    }
}

impl<S: System, M: Scheme<S>, O, A: Rounding> fmt::Debug for Ensemble<S, M, O, A> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Ensemble")
            .field("system", &self.description().map_or("", |one| &one.name))
            .field("scheme", &self.erased().describe())
            .field("members", &self.len())
            .field("step", &self.common.step)
            .field("steps", &self.common.steps)
            .finish_non_exhaustive()
    }
}
