//! Members that are made from their index, run to their ends and recorded.
//!
//! Input: a system and a start for each index, a scheme, a step, an end, a record. Output: rows in the order of the
//! index. Invariant: only the chunks that are being computed are in memory.

mod host;

use super::bound::ErasedScheme;
use super::record::{End, Record};
use super::rounding::{Fused, Rounding, Unfused};
use super::threads;
use super::{MakeMember, Member};
use crate::errors::Error;
use crate::observers::observe::{Observer, Unobserved};
use crate::results::shard::Shard;
use crate::schemes::scheme::Scheme;
use crate::schemes::{Adaptive, ToTolerance, Tolerance};
use crate::systems::state::State;
use crate::systems::system::{System, VectorOf};
use alloc::boxed::Box;
use alloc::string::String;
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::marker::PhantomData;
use core::ops::Range;
use core::sync::atomic::{AtomicBool, Ordering};
pub(super) use host::SweepHost;

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

/// Makes members from their index, runs each to its end, and records numbers of it.
///
/// The states of members are not kept, so that memory does not limit their number.
/// [`Ensemble`](crate::Ensemble) keeps them.
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
/// | in this order | methods |
/// |---|---|
/// | attach observers, if any | [`observe`](Sweep::observe) |
/// | choose what is recorded: one of these, once | [`record`](Sweep::record), [`record_at`](Sweep::record_at), [`record_rows`](Sweep::record_rows), [`record_columns`](Sweep::record_columns) |
/// | run, on all cores | [`collect`](Sweep::collect) to a table, [`fold`](Sweep::fold) and [`try_fold`](Sweep::try_fold) row by row, `store` to a Zarr directory |
///
/// The other methods set options, anywhere before the run. The closure that records a member receives an
/// [`End`](crate::End): the state, the observer, the number of steps, the energy and the observables.
///
/// # Reproducibility
/// As for an [`Ensemble`](crate::Ensemble#reproducibility), results depend by default on the CPU, but not on threads,
/// chunks or shards. With [`reproducible`](Sweep::reproducible), a member has the bits of a single run on every CPU. The
/// part of a step before the end never fuses products and sums. Nor do observers, except
/// [`EnergyDrift`](crate::observers::EnergyDrift) and [`Monitors`](crate::observers::Monitors).
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
    pub(crate) chunk: Option<usize>,
    pub(crate) shard: Option<Shard>,
    pub(crate) threads: usize,
    rounding: PhantomData<A>,
    pub(crate) cancel: Option<&'a AtomicBool>,
    pub(crate) progress: Option<Box<dyn Fn(usize, usize) + Send + Sync + 'a>>,
}

/// The largest default number of members in a chunk: a multiple of the lanes of every pack.
const CHUNK: usize = 4800;
/// The smallest default number, the lanes of the widest pack.
const LANES: usize = 80;

impl<'a, S: ToTolerance> Sweep<'a, S, Adaptive<S::Scheme>>
where
    Adaptive<S::Scheme>: Scheme<S>,
{
    /// Describes a sweep over members with steps from a tolerance, each its own, by
    /// the scheme that [`Integrator::to_tolerance`](crate::Integrator::to_tolerance) takes. It still needs an end after the
    /// starts, and a record. A tolerance that is not positive is the error of each member.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let make = |member: Member| (Oscillator {}, State::new([member.index as f64], [0.0]));
    /// let table = Sweep::to_tolerance(4, make, 1e-10)
    ///     .with_end(10.0)
    ///     .record(["q"], |end| [end.state.q[0]])
    ///     .collect()?;
    /// for row in table.iter() {
    ///     assert!((row[1] - row[0] * 10.0_f64.cos()).abs() < 1e-8);
    /// }
    /// # Ok::<(), Error>(())
    /// ```
    pub fn to_tolerance(
        count: usize,
        make: impl Fn(Member) -> (S, State<VectorOf<S>>) + Send + Sync + 'a,
        tolerance: impl Into<Tolerance>,
    ) -> Self {
        Self::new(
            count,
            make,
            Adaptive::new(S::Scheme::default(), tolerance),
            1.0,
        )
    }
}

impl<'a, S: System, M: Scheme<S>> Sweep<'a, S, M> {
    /// Describes a sweep over `count` members with the step size `step`. It still needs an end and a record. `make` makes
    /// the system and the start of a member, on any thread.
    ///
    /// A member whose start or step size is invalid fails with this error; the others run.
    pub fn new(
        count: usize,
        make: impl Fn(Member) -> (S, State<VectorOf<S>>) + Send + Sync + 'a,
        scheme: M,
        step: f64,
    ) -> Self {
        Self::try_new(count, move |member| Ok(make(member)), scheme, step)
    }

    /// Describes a sweep as [`new`](Sweep::new) does, with a closure that returns a `Result`. Its error becomes that of
    /// the member.
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

impl<'a, S: System, M: Scheme<S>, O, R, A: Rounding> Sweep<'a, S, M, O, R, A> {
    /// Ends members after `n` steps. The last call of this method, [`with_end`](Sweep::with_end) and
    /// [`with_end_each`](Sweep::with_end_each) counts.
    #[must_use]
    pub fn with_steps(mut self, n: u64) -> Self {
        self.end = EndPoint::Steps(n);
        self
    }

    /// Ends members at the time `t`. A state between two steps is made by one shorter step, as in
    /// [`advance_until`](crate::Integrator::advance_until). A member that starts later fails with
    /// [`TimeError::Behind`](crate::errors::TimeError::Behind).
    #[must_use]
    pub fn with_end(mut self, t: f64) -> Self {
        self.end = EndPoint::Until(t);
        self
    }

    /// Ends each member at its own time, as [`with_end`](Sweep::with_end) does for all.
    #[must_use]
    pub fn with_end_each(mut self, t: impl Fn(Member) -> f64 + Send + Sync + 'a) -> Self {
        self.end = EndPoint::Each(Box::new(t));
        self
    }

    /// Sets a step size for each member, instead of a common one.
    #[must_use]
    pub fn with_step_each(mut self, step: impl Fn(Member) -> f64 + Send + Sync + 'a) -> Self {
        self.step_each = Some(Box::new(step));
        self
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

    /// Records one row per member, at its end: the numbers that the closure returns, in columns of these names. A member
    /// that failed has NaN in its row.
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
    /// The table has no column for the time: record it as another number. Members end at the last time, whatever other
    /// end is set.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let start = |member: Member| (Oscillator {}, State::new([0.1 * member.index as f64], [0.5]));
    /// let table = Sweep::new(10, start, ImplicitMidpoint::default(), 0.01)
    ///     .record_at([0.5, 1.0], ["t", "q"], |end| [end.state.t, end.state.q[0]])
    ///     .collect()?;
    /// assert_eq!(table.columns(), ["member", "t", "q", "status"]);
    /// assert_eq!(table.rows(), 20);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// The times are in the direction of the run. A member with a time before its start fails with
    /// [`TimeError::Behind`](crate::errors::TimeError::Behind). A member that failed has NaN in the rows of the times that
    /// it did not reach. If its observer ended a member, the row of the next time has its last state, and later rows have
    /// NaN.
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

    /// Records any number of rows per member, at its end, for example the states of a section. A member that failed has
    /// one row of NaN in a table, and none in a store.
    pub fn record_rows<const N: usize, I: IntoIterator<Item = [f64; N]>>(
        self,
        columns: [&str; N],
        rows: impl Fn(&End<'_, S, O>) -> I + Send + Sync + 'a,
    ) -> Sweep<'a, S, M, O, Record<'a, S, O>, A> {
        let write = move |end: &End<'_, S, O>, to: &mut Vec<f64>| {
            to.extend(rows(end).into_iter().flatten());
        };
        self.recorded(&columns, true, None, Box::new(write))
    }

    /// Records one row per member at its end, or one per member and time, in columns whose names are known at run time
    /// alone. The closure appends a number for each column. A number that it leaves out is NaN, and one too many is left
    /// out.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let start = |member: Member| (Oscillator {}, State::new([member.index as f64], [0.0]));
    /// let columns: Vec<String> = (1..=2).map(|power| format!("q^{power}")).collect();
    /// let table = Sweep::new(3, start, ImplicitMidpoint::default(), 0.01)
    ///     .with_steps(10)
    ///     .record_columns(&columns, None, |end, numbers| {
    ///         numbers.extend((1..=2).map(|power| end.state.q[0].powi(power)));
    ///     })
    ///     .collect()?;
    /// assert_eq!(table.columns(), ["member", "q^1", "q^2", "status"]);
    /// # Ok::<(), Error>(())
    /// ```
    pub fn record_columns<N: AsRef<str>>(
        self,
        columns: &[N],
        times: Option<Vec<f64>>,
        record: impl Fn(&End<'_, S, O>, &mut Vec<f64>) + Send + Sync + 'a,
    ) -> Sweep<'a, S, M, O, Record<'a, S, O>, A> {
        let columns: Vec<&str> = columns.iter().map(AsRef::as_ref).collect();
        let width = columns.len();
        let write = move |end: &End<'_, S, O>, to: &mut Vec<f64>| {
            let before = to.len();
            record(end, to);
            to.resize(before + width, f64::NAN);
        };
        self.recorded(&columns, times.is_some(), times, Box::new(write))
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
    /// Changes the state of each member after every `every` steps (0 counts as 1), except its last state. The closure
    /// receives the member and its state, whose time it must keep.
    ///
    /// A member that is changed goes on as a single run after [`set_state`](crate::Integrator::set_state). A state that
    /// cannot be a start is the error of its member.
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
        every: u64,
        change: impl Fn(Member, &mut State<VectorOf<S>>) + Send + Sync + 'a,
    ) -> Self {
        self.each = Some((every.max(1), Box::new(change)));
        self
    }

    /// Sets the seed from which [`Member::seed`] is computed. The default is 0.
    ///
    /// ```
    #[doc = include_str!("../doc/oscillator.md")]
    ///
    /// let start = |member: Member| {
    ///     // From 0 to 1; a generator of random numbers would be made from the seed here.
    ///     let random = member.seed as f64 / u64::MAX as f64;
    ///     (Oscillator {}, State::new([random], [0.0]))
    /// };
    /// let sum = Sweep::new(1_000, start, ImplicitMidpoint::default(), 0.01)
    ///     .with_seed(7)
    ///     .with_steps(100)
    ///     .record(["H"], |end| [end.energy()])
    ///     .fold(0.0, |sum, row| sum + row.values[0])?;
    /// assert!((sum / 1e3 - 1.0 / 6.0).abs() < 0.02); // ⟨q²⟩/2
    /// # Ok::<(), Error>(())
    /// ```
    #[must_use]
    pub fn with_seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// Sets the number of members in a chunk (0 counts as 1). A thread computes one chunk at a time, a store has a file
    /// for each chunk and array, and [`with_shard`](Sweep::with_shard) divides the chunks among processes.
    ///
    /// By default there are about 64 chunks of at most 4800 members. A sweep that continues a store has the chunks of
    /// that store.
    #[must_use]
    pub fn with_chunk(mut self, members: usize) -> Self {
        self.chunk = Some(members.max(1));
        self
    }

    /// Computes only the chunks of this shard. `Shard::from_env()?` is the shard of a process that MPI, Slurm or
    /// HyperQueue has started.
    #[must_use]
    pub fn with_shard(mut self, shard: Shard) -> Self {
        self.shard = Some(shard);
        self
    }

    /// Sets the number of threads (0 counts as 1). The default is the number that the machine runs at once. In a rayon
    /// pool, the sweep has the threads of the pool.
    #[must_use]
    pub fn with_threads(mut self, threads: usize) -> Self {
        self.threads = threads.max(1);
        self
    }

    /// Turns fused products and sums off, so that each member has the bits of its single run on every CPU.
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

    /// Stops the sweep with [`SweepError::Cancelled`](crate::errors::SweepError::Cancelled) once the flag is set, for
    /// example by a handler of Ctrl-C. The flag is read between blocks of steps. A store keeps the chunks that were
    /// finished, and the next `store` computes the others.
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
