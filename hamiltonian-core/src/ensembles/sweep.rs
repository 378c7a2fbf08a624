//! Members that are made from their index, run to their ends and recorded.
//!
//! Input: a system and a start for each index, a scheme, a step, an end, a record. Output: rows in the order of the
//! index. Invariant: only the chunks that are being computed are in memory.

mod host;

use super::bound::ErasedScheme;
use super::guard::guard;
use super::ordered::in_order;
use super::record::{Batch, End, Record, Row};
use super::rounding::{Fused, Rounding, Unfused};
use super::threads;
use super::{MakeMember, Member};
use crate::errors::{Error, SweepError, TimeError};
use crate::observers::observe::{Observer, Unobserved};
use crate::results::shard::Shard;
use crate::results::table::Table;
use crate::schemes::scheme::Scheme;
use crate::systems::state::State;
use crate::systems::system::{System, VectorOf};
use alloc::boxed::Box;
use alloc::string::String;
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::marker::PhantomData;
use core::ops::{ControlFlow, Range};
use core::sync::atomic::{AtomicBool, Ordering};
use host::SweepHost;

/// A closure that returns a number for each member.
type PerMember<'a> = Box<dyn Fn(Member) -> f64 + Send + Sync + 'a>;

/// A closure that may change the state of a member.
type ChangeMember<'a, S> = Box<dyn Fn(Member, &mut State<VectorOf<S>>) + Send + Sync + 'a>;

/// The end of members.
pub(crate) enum EndPoint<'a> {
    /// Not set.
    Unknown,
    /// After this number of steps.
    Steps(u64),
    /// At this time.
    Until(f64),
    /// Each at its own time.
    Each(PerMember<'a>),
}

/// Members that are made from their index, run to their end and recorded. Their states are not kept, so memory does
/// not limit their number.
///
/// The methods first describe the sweep: its end, an observer, the record. [`collect`](Sweep::collect),
/// [`fold`](Sweep::fold) and [`try_fold`](Sweep::try_fold) run it, on all cores.
///
/// ```
#[doc = include_str!("../doc/oscillator.md")]
///
/// let start = |member: Member| (Oscillator {}, State::new([0.1 * member.index as f64], [0.5]));
/// let table = Sweep::new(100, start, ImplicitMidpoint::default(), 0.01)
///     .with_end(1.005)
///     .observe(|_member| EnergyDrift::new())
///     .record(["q", "drift"], |end| [end.state.q[0], end.observer.max_relative()])
///     .collect()?;
/// assert_eq!(table.rows(), 100);
/// assert!(table.column("drift").is_some_and(|mut drift| drift.all(|drift| drift < 1e-12)));
/// # Ok::<(), Error>(())
/// ```
///
/// # Bits
/// As for an [`Ensemble`](crate::Ensemble), the bits of a member depend on neither threads nor chunks nor shards. With
/// [`reproducible`](Sweep::reproducible), a member has the bits of a single run on every CPU. The part of a step before
/// the end is computed over `f64` without fused products, in both modes. So are the values of observers, except those
/// of [`EnergyDrift`](crate::observers::EnergyDrift) and [`Monitors`](crate::observers::Monitors).
pub struct Sweep<'a, S: System, M, O = (), R = (), A = Fused> {
    pub(crate) count: usize,
    pub(crate) scheme: M,
    pub(crate) make: MakeMember<'a, S>,
    pub(crate) step: f64,
    pub(crate) step_each: Option<PerMember<'a>>,
    pub(crate) end: EndPoint<'a>,
    /// The number of steps between two changes of a member, and the change.
    pub(crate) each: Option<(u64, ChangeMember<'a, S>)>,
    pub(crate) observer: Arc<dyn Fn(Member) -> O + Send + Sync + 'a>,
    pub(crate) record: R,
    pub(crate) seed: u64,
    chunk: Option<usize>,
    shard: Option<Shard>,
    threads: usize,
    rounding: PhantomData<A>,
    cancel: Option<&'a AtomicBool>,
    progress: Option<Box<dyn Fn(usize, usize) + Send + Sync + 'a>>,
}

/// The largest default number of members in a chunk: a multiple of the lanes of every pack.
const CHUNK: usize = 4800;
/// The smallest default number, the lanes of the widest pack.
const LANES: usize = 80;

impl<'a, S: System, M: Scheme<S>> Sweep<'a, S, M> {
    /// Describes a sweep over `count` members with the step `step`, which still needs an end and a record. `make` makes
    /// the system and the start of a member, on any thread.
    pub fn new(
        count: usize,
        make: impl Fn(Member) -> (S, State<VectorOf<S>>) + Send + Sync + 'a,
        scheme: M,
        step: f64,
    ) -> Self {
        Self::try_new(count, move |member| Ok(make(member)), scheme, step)
    }

    /// Does the same as [`new`](Sweep::new) with a closure that returns a `Result`. Its error becomes that of the
    /// member.
    pub fn try_new(
        count: usize,
        make: impl Fn(Member) -> Result<(S, State<VectorOf<S>>), Error> + Send + Sync + 'a,
        scheme: M,
        step: f64,
    ) -> Self {
        Sweep {
            count,
            scheme,
            make: Box::new(make),
            step,
            step_each: None,
            end: EndPoint::Unknown,
            each: None,
            observer: Arc::new(|_| ()),
            record: (),
            seed: 0,
            chunk: None,
            shard: None,
            threads: threads::available(),
            rounding: PhantomData,
            cancel: None,
            progress: None,
        }
    }
}

impl<'a, S: System, M: Scheme<S>, O, A: Rounding> Sweep<'a, S, M, O, (), A> {
    /// Attaches an observer to each member, as in a single run. An observer that ends its member ends no other.
    ///
    /// Call `observe` once. For several observers, return a tuple.
    pub fn observe<N: Observer<f64, S>>(
        self,
        observer: impl Fn(Member) -> N + Send + Sync + 'a,
    ) -> Sweep<'a, S, M, N, (), A>
    where
        O: Unobserved,
    {
        self.with(Arc::new(observer), ())
    }

    /// Records one row per member: the numbers that the closure computes at its end, in columns of these names. A
    /// member that failed has NaN in its row.
    pub fn record<const N: usize>(
        self,
        columns: [&str; N],
        record: impl Fn(&End<'_, S, O>) -> [f64; N] + Send + Sync + 'a,
    ) -> Sweep<'a, S, M, O, Record<'a, S, O>, A> {
        let write = move |end: &End<'_, S, O>, to: &mut Vec<f64>| to.extend(record(end));
        self.recorded(&columns, false, None, Box::new(write))
    }

    /// Records one row per member and time. The closure receives the member at each time.
    ///
    /// The times are in the direction of the run, and members end at the last one. A member with a time before its
    /// start fails with [`TimeError::Behind`]. A member that failed has NaN in the rows of the times that it did not
    /// reach. If its observer ended a member, the row of the next time has its last state, and later rows have NaN.
    pub fn record_at<const N: usize>(
        self,
        times: impl IntoIterator<Item = f64>,
        columns: [&str; N],
        record: impl Fn(&End<'_, S, O>) -> [f64; N] + Send + Sync + 'a,
    ) -> Sweep<'a, S, M, O, Record<'a, S, O>, A> {
        let write = move |end: &End<'_, S, O>, to: &mut Vec<f64>| to.extend(record(end));
        let times = times.into_iter().collect();
        self.recorded(&columns, true, Some(times), Box::new(write))
    }

    /// Records any number of rows per member, for example the states of a section. A member that failed has one row of
    /// NaN in a table, and none in a store.
    pub fn rows<const N: usize, I: IntoIterator<Item = [f64; N]>>(
        self,
        columns: [&str; N],
        rows: impl Fn(&End<'_, S, O>) -> I + Send + Sync + 'a,
    ) -> Sweep<'a, S, M, O, Record<'a, S, O>, A> {
        let write = move |end: &End<'_, S, O>, to: &mut Vec<f64>| {
            to.extend(rows(end).into_iter().flatten());
        };
        self.recorded(&columns, true, None, Box::new(write))
    }

    fn recorded(
        self,
        columns: &[&str],
        several: bool,
        times: Option<Vec<f64>>,
        write: super::record::Write<'a, S, O>,
    ) -> Sweep<'a, S, M, O, Record<'a, S, O>, A> {
        let record = Record {
            columns: columns.iter().map(|name| String::from(*name)).collect(),
            several,
            times,
            write,
        };
        let observer = Arc::clone(&self.observer);
        self.with(observer, record)
    }
}

impl<'a, S: System, M: Scheme<S>, O, R, A: Rounding> Sweep<'a, S, M, O, R, A> {
    /// Replaces the observer and the record.
    fn with<N, Q>(
        self,
        observer: Arc<dyn Fn(Member) -> N + Send + Sync + 'a>,
        record: Q,
    ) -> Sweep<'a, S, M, N, Q, A> {
        Sweep {
            count: self.count,
            scheme: self.scheme,
            make: self.make,
            step: self.step,
            step_each: self.step_each,
            end: self.end,
            each: self.each,
            observer,
            record,
            seed: self.seed,
            chunk: self.chunk,
            shard: self.shard,
            threads: self.threads,
            rounding: PhantomData,
            cancel: self.cancel,
            progress: self.progress,
        }
    }

    /// Ends members after `n` steps.
    #[must_use]
    pub fn with_steps(mut self, n: u64) -> Self {
        self.end = EndPoint::Steps(n);
        self
    }

    /// Ends members at the time `t`. A state between two steps is computed by a part of a step, as in
    /// [`advance_until`](crate::Integrator::advance_until).
    #[must_use]
    pub fn with_end(mut self, t: f64) -> Self {
        self.end = EndPoint::Until(t);
        self
    }

    /// Ends each member at its own time.
    #[must_use]
    pub fn with_end_each(mut self, t: impl Fn(Member) -> f64 + Send + Sync + 'a) -> Self {
        self.end = EndPoint::Each(Box::new(t));
        self
    }

    /// Changes each member after every `n` steps (0 counts as 1), but for its last state: the closure receives the member
    /// and its state, whose time it must keep. A member that is changed goes on as a single run after
    /// [`set_state`](crate::Integrator::set_state). A state that cannot be a start is the error of its member.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// // A kicked oscillator, for kicks of different sizes.
    /// let start = |_| (Oscillator {}, State::new([1.0], [0.0]));
    /// let table = Sweep::new(10, start, StormerVerlet::default(), 0.01)
    ///     .with_steps(1_000)
    ///     .each(100, |member, state| state.p[0] += 0.1 * member.index as f64 * state.q[0].sin())
    ///     .record(["q", "p"], |end| [end.state.q[0], end.state.p[0]])
    ///     .collect()?;
    /// assert_eq!(table.rows(), 10);
    /// # Ok::<(), Error>(())
    /// ```
    #[must_use]
    pub fn each(
        mut self,
        n: u64,
        change: impl Fn(Member, &mut State<VectorOf<S>>) + Send + Sync + 'a,
    ) -> Self {
        self.each = Some((n.max(1), Box::new(change)));
        self
    }

    /// Sets a step for each member, instead of a common one.
    #[must_use]
    pub fn with_step_each(mut self, step: impl Fn(Member) -> f64 + Send + Sync + 'a) -> Self {
        self.step_each = Some(Box::new(step));
        self
    }

    /// Sets the seed from which [`Member::seed`] is computed. The default is 0.
    #[must_use]
    pub fn with_seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// Sets the number of members in a chunk (0 counts as 1). A chunk is the unit of work of a thread, and has a file
    /// per array in a store.
    #[must_use]
    pub fn with_chunk(mut self, members: usize) -> Self {
        self.chunk = Some(members.max(1));
        self
    }

    /// Computes only the chunks of this shard.
    #[must_use]
    pub fn with_shard(mut self, shard: Shard) -> Self {
        self.shard = Some(shard);
        self
    }

    /// Sets the number of threads (0 counts as 1). By default it is the number that the machine runs at once. A caller
    /// in a rayon pool gets those of the pool, and no others.
    #[must_use]
    pub fn with_threads(mut self, threads: usize) -> Self {
        self.threads = threads.max(1);
        self
    }

    /// Does not fuse products and sums, so that each member has the bits of its single run on every CPU.
    #[must_use]
    pub fn reproducible(self) -> Sweep<'a, S, M, O, R, Unfused> {
        Sweep {
            count: self.count,
            scheme: self.scheme,
            make: self.make,
            step: self.step,
            step_each: self.step_each,
            end: self.end,
            each: self.each,
            observer: self.observer,
            record: self.record,
            seed: self.seed,
            chunk: self.chunk,
            shard: self.shard,
            threads: self.threads,
            rounding: PhantomData,
            cancel: self.cancel,
            progress: self.progress,
        }
    }

    /// Returns the scheme without its type.
    pub(crate) fn erased(&self) -> &dyn ErasedScheme<S> {
        &self.scheme
    }

    /// Stops the sweep with [`SweepError::Cancelled`] once the flag is set, for example by a handler of Ctrl-C.
    #[must_use]
    pub fn with_cancel(mut self, flag: &'a AtomicBool) -> Self {
        self.cancel = Some(flag);
        self
    }

    /// Calls a closure after each chunk with the number of finished members and the number of all members of this
    /// shard.
    #[must_use]
    pub fn with_progress(mut self, closure: impl Fn(usize, usize) + Send + Sync + 'a) -> Self {
        self.progress = Some(Box::new(closure));
        self
    }

    pub(crate) fn is_cancelled(&self) -> bool {
        self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    /// The number of members in a chunk.
    pub(crate) fn chunk_size(&self) -> usize {
        let size = self
            .count
            .div_ceil(64)
            .next_multiple_of(LANES)
            .clamp(1, CHUNK);
        self.chunk.unwrap_or(size)
    }

    /// Returns the members of each chunk of this shard.
    pub(crate) fn chunks(&self) -> Vec<Range<usize>> {
        let size = self.chunk_size();
        let chunks = (0..self.count.div_ceil(size)).filter(|chunk| match &self.shard {
            Some(shard) => shard.has(*chunk as u64),
            None => true,
        });
        let members = chunks.map(|chunk| chunk * size..self.count.min((chunk + 1) * size));
        members.collect()
    }
}

impl<'a, S, M, O, A> Sweep<'a, S, M, O, Record<'a, S, O>, A>
where
    S: System,
    M: Scheme<S>,
    A: Rounding,
    O: Observer<f64, S>,
{
    /// Runs the sweep and passes its rows to a closure, one by one in the order of the index, on this thread.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let start = |member: Member| (Oscillator {}, State::new([0.1 * member.index as f64], [0.5]));
    /// let largest = Sweep::new(100, start, ImplicitMidpoint::default(), 0.01)
    ///     .with_steps(100)
    ///     .record(["q"], |end| [end.state.q[0]])
    ///     .fold(0.0_f64, |largest, row| largest.max(row.values[0]))?;
    /// assert!((largest - (9.9 * 1_f64.cos() + 0.5 * 1_f64.sin())).abs() < 1e-3);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`SweepError::NoMembers`], [`SweepError::NoEnd`], [`SweepError::Cancelled`]; for the times of
    /// [`record_at`](Sweep::record_at), [`TimeError::Unreachable`] if one is NaN or infinite, and
    /// [`TimeError::Behind`] if one comes before the previous one. The error of a member is in its row.
    pub fn fold<U>(&self, init: U, mut take: impl FnMut(U, &Row<'_>) -> U) -> Result<U, Error> {
        self.try_fold(init, |all, row| ControlFlow::Continue(take(all, row)))
    }

    /// Does the same as [`fold`](Sweep::fold) until the closure breaks. The rows that it receives do not depend on the
    /// number of threads: later chunks are dropped.
    ///
    /// # Errors
    /// Those of [`fold`](Sweep::fold).
    pub fn try_fold<U>(
        &self,
        init: U,
        mut take: impl FnMut(U, &Row<'_>) -> ControlFlow<U, U>,
    ) -> Result<U, Error> {
        let mut all = Some(init);
        self.each_batch(self.chunks(), false, |batch| {
            for row in batch.rows() {
                match all.take().map(|so_far| take(so_far, &row)) {
                    Some(ControlFlow::Continue(so_far)) => all = Some(so_far),
                    Some(ControlFlow::Break(last)) => {
                        all = Some(last);
                        return Ok(ControlFlow::Break(()));
                    }
                    None => {}
                }
            }
            Ok(ControlFlow::Continue(()))
        })?;
        all.ok_or(SweepError::NoMembers.into())
    }

    /// Runs the sweep and collects the rows into a table. The first column, `member`, has the index of the member. The
    /// last column, `status`, says how the member ended, see [`Status`](crate::Status).
    ///
    /// # Errors
    /// Those of [`fold`](Sweep::fold); [`TableError::Twice`](crate::errors::TableError::Twice) for a name that
    /// occurs twice, or is `member` or `status`.
    pub fn collect(&self) -> Result<Table, Error> {
        let columns = self.record.columns.iter().map(String::as_str);
        let mut table = Table::with_index("member", columns.chain(["status"]))?;
        let any = self.record.rows_each().is_none();
        let mut line = Vec::new();
        self.each_batch(self.chunks(), false, |batch| {
            for row in batch.rows() {
                if row.values.is_empty() && any {
                    continue;
                }
                line.clear();
                line.push(row.index as f64);
                line.extend_from_slice(row.values);
                line.push(f64::from(row.status as u8));
                table.push(&line)?;
            }
            Ok(ControlFlow::Continue(()))
        })?;
        Ok(table)
    }

    /// Checks that the sweep has members, that they have ends, and that the times of its record are in order.
    pub(crate) fn check(&self) -> Result<(), Error> {
        if self.count == 0 {
            return Err(SweepError::NoMembers.into());
        }
        match (&self.record.times, &self.end) {
            (Some(times), _) if times.is_empty() => Err(SweepError::NoEnd.into()),
            (None, EndPoint::Unknown) => Err(SweepError::NoEnd.into()),
            (Some(times), _) => Ok(self.check_times(times)?),
            _ => Ok(()),
        }
    }

    /// Makes the system of the first member that can be made.
    pub(crate) fn first_system(&self) -> Option<S> {
        let made = |index| guard(|| (self.make)(Member::new(index, self.seed)));
        let mut systems = (0..self.count).filter_map(|index| made(index).ok()?.ok());
        systems.next().map(|(system, _)| system)
    }

    /// Checks that times are finite, and in the direction of the common step. If each member has its own step, any
    /// direction is accepted here, and members that run in the other one fail.
    fn check_times(&self, times: &[f64]) -> Result<(), TimeError> {
        let clock = || {
            let system = self.first_system();
            let clock = system
                .as_ref()
                .map_or("t", |system| system.description().clock());
            clock.into()
        };
        if let Some(&target) = times.iter().find(|t| !t.is_finite()) {
            let clock = clock();
            return Err(TimeError::Unreachable { clock, target });
        }
        let direction = match self.step_each {
            Some(_) => times[times.len() - 1] - times[0],
            None => self.step,
        };
        let is_behind =
            |pair: &&[f64]| (pair[1] < pair[0]) != (pair[1] != pair[0] && direction < 0.0);
        match times.windows(2).find(is_behind) {
            Some(pair) => Err(TimeError::Behind {
                clock: clock(),
                target: pair[1],
                now: pair[0],
            }),
            None => Ok(()),
        }
    }

    /// Runs chunks and passes their batches to a closure in order; `hashes` is true if members are hashed for a store.
    pub(crate) fn each_batch(
        &self,
        chunks: Vec<Range<usize>>,
        hashes: bool,
        mut take: impl FnMut(Batch) -> Result<ControlFlow<()>, Error>,
    ) -> Result<(), Error> {
        self.check()?;
        let of = chunks.iter().map(Range::len).sum();
        let mut done = 0;
        let mut result = Ok(());
        let work = |job: usize| SweepHost::new(self, chunks[job].clone(), hashes).batch();
        in_order(chunks.len(), self.threads, work, |_, batch| {
            if batch.cancelled {
                result = Err(SweepError::Cancelled { done, of }.into());
                return ControlFlow::Break(());
            }
            done += batch.outcomes.len();
            let taken = take(batch);
            if let Some(progress) = &self.progress {
                progress(done, of);
            }
            taken.unwrap_or_else(|error| {
                result = Err(error);
                ControlFlow::Break(())
            })
        });
        result
    }
}

impl<S: System, M: Scheme<S>, O, R, A: Rounding> core::fmt::Debug for Sweep<'_, S, M, O, R, A> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Sweep")
            .field("system", &core::any::type_name::<S>())
            .field("scheme", &self.erased().describe())
            .field("members", &self.count)
            .field("step", &self.step)
            .field("seed", &self.seed)
            .finish_non_exhaustive()
    }
}
