//! Records of members: what a sweep keeps.
//!
//! Input: the ends of members. Output: [`Row`]s of numbers, in the order of the index.

use super::Member;
use crate::error::Error;
use crate::state::State;
use crate::system::{Dynamics, System, declared_energy};
use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;

/// A member at its end, or at a time at which it is recorded.
pub struct End<'v, S: System<f64>, O> {
    /// The member.
    pub member: Member,
    /// Its state.
    pub state: &'v State<S::Vector>,
    /// Its observer.
    pub observer: &'v O,
    /// The number of whole steps made.
    pub steps: u64,
    /// True if its observer has ended it.
    pub stopped: bool,
    pub(crate) prepared: &'v S::Prepared,
}

impl<S: System<f64>, O> End<'_, S, O> {
    /// H here, as it was declared.
    pub fn energy(&self) -> f64 {
        declared_energy::<f64, S>(self.prepared, self.state)
    }

    /// The observable of that name here; `None` if there is none.
    pub fn observable_named(&self, name: &str) -> Option<f64> {
        let State { t, q, p } = self.state;
        S::observable_index(name).map(|index| self.prepared.observable(index, *t, q, p))
    }
}

/// Writes the numbers of a member.
pub(crate) type Write<'a, S, O> = Box<dyn Fn(&End<'_, S, O>, &mut Vec<f64>) + Send + Sync + 'a>;

/// The record of a sweep: its columns, and how they are written.
pub struct Record<'a, S: System<f64>, O> {
    pub(crate) columns: Vec<String>,
    /// True if a member may have another number of rows than one.
    pub(crate) several: bool,
    /// Times at which members are recorded; at their end if there are none.
    pub(crate) times: Option<Vec<f64>>,
    pub(crate) write: Write<'a, S, O>,
}

/// How a member ended. As a number it is the `status` of a stored sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
#[repr(u8)]
pub enum Status {
    /// It has not been computed.
    Missing = 0,
    /// It has reached its end.
    Ended = 1,
    /// Its observer has ended it, at an event for example.
    Stopped = 2,
    /// It could not start: [`Error::Start`], [`Error::Values`] and others of a start.
    Start = 3,
    /// [`Error::NotFinite`].
    NotFinite = 4,
    /// [`Error::Solve`].
    Unsolved = 5,
    /// [`Error::Panicked`].
    Panicked = 6,
    /// Another error on the way.
    Failed = 7,
}

impl Status {
    /// That of an error, before the first step or later.
    pub(crate) fn of(error: &Error, begun: bool) -> Self {
        match error {
            Error::Panicked { .. } => Status::Panicked,
            _ if !begun => Status::Start,
            Error::NotFinite { .. } => Status::NotFinite,
            Error::Solve { .. } => Status::Unsolved,
            _ => Status::Failed,
        }
    }
}

/// A row of a sweep.
#[derive(Debug)]
pub struct Row<'r> {
    /// The index of the member.
    pub index: usize,
    /// How it ended.
    pub status: Status,
    /// The time at which it did.
    pub time: f64,
    /// The number of whole steps that it made.
    pub steps: u64,
    /// One value a column: NaN for a member that failed; none at all where members have several rows and
    /// this one has none.
    pub values: &'r [f64],
    /// Its error, if it failed.
    pub error: Option<&'r Error>,
}

/// How a member ended, with the place of its numbers.
#[derive(Debug)]
pub(crate) struct Outcome {
    pub(crate) status: Status,
    pub(crate) time: f64,
    pub(crate) steps: u64,
    pub(crate) values: core::ops::Range<usize>,
    /// A hash of its parameters, its start and its step; 0 where it could not be made.
    #[cfg_attr(not(feature = "std"), allow(dead_code))]
    pub(crate) hash: u64,
    pub(crate) error: Option<Error>,
}

/// The members of a chunk, all at their ends.
#[derive(Debug)]
pub(crate) struct Batch {
    pub(crate) first: usize,
    pub(crate) columns: usize,
    pub(crate) outcomes: Vec<Outcome>,
    pub(crate) values: Vec<f64>,
    /// True if it was cancelled on the way, so that some are missing.
    pub(crate) cancelled: bool,
}

impl Batch {
    /// The rows, in the order of the index.
    pub(crate) fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        let columns = self.columns.max(1);
        let outcomes = self.outcomes.iter().zip(self.first..);
        outcomes.flat_map(move |(outcome, index)| {
            let values = &self.values[outcome.values.clone()];
            // A member without a row is seen once.
            let rows = (values.len() / columns).max(1);
            (0..rows).map(move |row| Row {
                index,
                status: outcome.status,
                time: outcome.time,
                steps: outcome.steps,
                values: values
                    .get(row * columns..(row + 1) * columns)
                    .unwrap_or_default(),
                error: outcome.error.as_ref(),
            })
        })
    }
}
