//! The run of a sweep, with its rows in a table or passed to a closure.
//!
//! Input: a sweep. Output: a [`Table`], or the value of a fold. Invariant: rows come in the order of the index, whatever
//! the number of threads.

use super::Member;
use super::guard::guard;
use super::ordered::in_order;
use super::record::{Batch, Record, Row};
use super::rounding::Rounding;
use super::sweep::{EndPoint, Sweep, SweepHost};
use crate::errors::{Error, SweepError, TimeError};
use crate::observers::observe::Observer;
use crate::results::table::Table;
use crate::schemes::scheme::Scheme;
use crate::systems::system::System;
use alloc::string::String;
use alloc::vec::Vec;
use core::ops::{ControlFlow, Range};

impl<'a, S, M, O, A> Sweep<'a, S, M, O, Record<'a, S, O>, A>
where
    S: System,
    M: Scheme<S>,
    A: Rounding,
    O: Observer<f64, S>,
{
    /// Runs the sweep and collects the rows into a table. The first column, `member`, has the index of the member. The
    /// last column, `status`, has the number of its [`Status`](crate::Status): 1 if it reached its end, 2 if its observer
    /// ended it, above 2 if it failed. [`fold`](Sweep::fold) has the errors themselves.
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
    /// [`TimeError::Behind`] if one comes before the previous one. The error of a member is [`Row::error`].
    pub fn fold<U>(&self, init: U, mut take: impl FnMut(U, &Row<'_>) -> U) -> Result<U, Error> {
        self.try_fold(init, |all, row| ControlFlow::Continue(take(all, row)))
    }

    /// Runs the sweep as [`fold`](Sweep::fold) does, until the closure breaks. The rows that it receives do not depend on
    /// the number of threads: later chunks are dropped.
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
