//! The results of members that a sweep stores.
//!
//! Input: the ends of members. Output: [`Row`]s of numbers, in the order of the index.

use super::Member;
use crate::errors::{Error, StepError, SweepError};
use crate::systems::state::State;
use crate::systems::system::{Dynamics, System, VectorOf, declared_energy};
use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;

/// A member at its end, or at a time at which it is recorded.
pub struct End<'v, S: System, O> {
    /// The member.
    pub member: Member,
    /// Its state.
    pub state: &'v State<VectorOf<S>>,
    /// Its observer.
    pub observer: &'v O,
    /// The number of whole steps made.
    pub steps: u64,
    /// True if its observer has ended it.
    pub stopped: bool,
    pub(crate) prepared: &'v S::Prepared<f64>,
}

impl<S: System, O> End<'_, S, O> {
    /// The declared H at this state.
    pub fn energy(&self) -> f64 {
        declared_energy::<f64, S>(self.prepared, self.state)
    }

    /// The observable of that name at this state; `None` if there is none.
    pub fn observable_named(&self, name: &str) -> Option<f64> {
        let State { t, q, p } = self.state;
        let index = self.prepared.description().observable_index(name)?;
        Some(self.prepared.observable(index, *t, q, p))
    }
}

/// Writes the numbers of a member.
pub(crate) type Write<'a, S, O> = Box<dyn Fn(&End<'_, S, O>, &mut Vec<f64>) + Send + Sync + 'a>;

/// The record of a sweep: its columns and the closure that computes them.
pub struct Record<'a, S: System, O> {
    pub(crate) columns: Vec<String>,
    /// True if a member may have any number of rows; false if it has one.
    pub(crate) several: bool,
    /// Times at which members are recorded. Without them, members are recorded at their ends.
    pub(crate) times: Option<Vec<f64>>,
    pub(crate) write: Write<'a, S, O>,
}

impl<S: System, O> Record<'_, S, O> {
    /// The number of rows of each member; `None` if it may be any.
    pub(crate) fn rows_each(&self) -> Option<usize> {
        match &self.times {
            Some(times) => Some(times.len()),
            None => (!self.several).then_some(1),
        }
    }
}

/// How a member ended. The number of a variant is the `status` in stored sweeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
#[repr(u8)]
pub enum Status {
    /// The member has not been computed.
    Missing = 0,
    /// The member has reached its end.
    Ended = 1,
    /// The member's observer has ended it, for example at an event.
    Stopped = 2,
    /// The member could not start: [`StartError::NotFinite`](crate::errors::StartError::NotFinite),
    /// [`StartError::Values`](crate::errors::StartError::Values) or another error of a start.
    Start = 3,
    /// [`StepError::NotFinite`].
    NotFinite = 4,
    /// [`StepError::Unsolved`].
    Unsolved = 5,
    /// [`SweepError::Panicked`].
    Panicked = 6,
    /// Another error after the start.
    Failed = 7,
}

impl Status {
    /// Returns the status for an error; `begun` is false for an error of the start.
    pub(crate) fn of(error: &Error, begun: bool) -> Self {
        match error {
            Error::Sweep(SweepError::Panicked { .. }) => Status::Panicked,
            _ if !begun => Status::Start,
            Error::Step(StepError::NotFinite { .. }) => Status::NotFinite,
            Error::Step(StepError::Unsolved { .. }) => Status::Unsolved,
            _ => Status::Failed,
        }
    }
}

/// A row of a sweep.
#[derive(Debug)]
pub struct Row<'r> {
    /// The index of the member.
    pub index: usize,
    /// How the member ended.
    pub status: Status,
    /// The time at which the member ended.
    pub time: f64,
    /// The number of whole steps that the member made.
    pub steps: u64,
    /// One value per column. They are NaN if the member failed, or ended before the time of the row. Empty if members
    /// have any number of rows and this member, which did not fail, has none.
    pub values: &'r [f64],
    /// The member's error, if it failed.
    pub error: Option<&'r Error>,
}

/// How a member ended, with the range of its values.
#[derive(Debug)]
pub(crate) struct MemberOutcome {
    pub(crate) status: Status,
    pub(crate) time: f64,
    pub(crate) steps: u64,
    pub(crate) values: core::ops::Range<usize>,
    /// A hash of its parameters, its start and its step; 0 if it could not be made.
    #[cfg_attr(not(feature = "std"), allow(dead_code))]
    pub(crate) hash: u64,
    pub(crate) error: Option<Error>,
}

/// The members of a chunk, all at their ends.
#[derive(Debug)]
pub(crate) struct Batch {
    pub(crate) first: usize,
    /// A row of NaN, for members that failed and for times that were not reached.
    pub(crate) nan: Vec<f64>,
    /// The number of rows of each member; `None` if it may be any.
    pub(crate) rows_each: Option<usize>,
    pub(crate) outcomes: Vec<MemberOutcome>,
    pub(crate) values: Vec<f64>,
    /// True if the sweep was cancelled, so that members may be missing.
    pub(crate) cancelled: bool,
}

impl Batch {
    /// The rows, in the order of the index.
    pub(crate) fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        let columns = self.nan.len().max(1);
        let outcomes = self.outcomes.iter().zip(self.first..);
        outcomes.flat_map(move |(outcome, index)| {
            let values = &self.values[outcome.values.clone()];
            // A member without rows has one `Row` with its status.
            let found = (values.len() / columns).max(1);
            let missing: &[f64] = match self.rows_each.is_some() || outcome.error.is_some() {
                true => &self.nan,
                false => &[],
            };
            (0..self.rows_each.unwrap_or(found)).map(move |row| Row {
                index,
                status: outcome.status,
                time: outcome.time,
                steps: outcome.steps,
                values: values
                    .get(row * columns..(row + 1) * columns)
                    .unwrap_or(missing),
                error: outcome.error.as_ref(),
            })
        })
    }
}
