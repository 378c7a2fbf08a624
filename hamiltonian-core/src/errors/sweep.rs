//! Errors of ensembles and sweeps.

use super::Error;
use alloc::boxed::Box;
use core::fmt::{self, Display, Formatter};

/// Why an ensemble or a sweep is refused or ended early, or the error of one of its members.
#[derive(Clone, PartialEq)]
#[non_exhaustive]
pub enum SweepError {
    /// A member failed.
    #[non_exhaustive]
    Member {
        /// Its index.
        index: usize,
        /// Its error.
        error: Box<Error>,
    },
    /// There are no members.
    #[non_exhaustive]
    NoMembers,
    /// The members of a sweep have no end.
    #[non_exhaustive]
    NoEnd,
    /// No common number of steps leads the members to one time.
    #[non_exhaustive]
    Apart {
        /// The difference between the members.
        reason: Box<str>,
    },
    /// A member has other run-time sizes, or other functions as parameters, than the first one.
    #[non_exhaustive]
    OtherSizes {
        /// The system.
        system: Box<str>,
    },
    /// A member had failed before its ensemble was saved.
    #[non_exhaustive]
    Before {
        /// The message of its error.
        message: Box<str>,
    },
    /// The sweep was cancelled.
    #[non_exhaustive]
    Cancelled {
        /// The number of members that were done.
        done: usize,
        /// The number of members to be done.
        of: usize,
    },
    /// A closure panicked.
    #[non_exhaustive]
    Panicked {
        /// The message of the panic.
        message: Box<str>,
    },
}

impl SweepError {
    /// Returns the error of a member.
    pub(crate) fn member(index: usize, error: Error) -> Error {
        let error = Box::new(error);
        SweepError::Member { index, error }.into()
    }
}

impl Display for SweepError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Member { index, error } => write!(f, "member {index}: {error}"),
            Self::NoMembers => f.write_str("an ensemble has at least one member, found 0"),
            Self::NoEnd => f.write_str(
                "the members of the sweep have no end\n\
                 help: give them one: `.with_end(t)`, `.with_steps(n)`, or at least one time of \
                 `.record_at(…)`",
            ),
            Self::Apart { reason } => write!(
                f,
                "no number of steps leads all members to one time, since {reason}; a `Sweep` ends \
                 each at its time"
            ),
            Self::OtherSizes { system } => write!(
                f,
                "`{system}` has other sizes or functions than in member 0: members of one ensemble \
                 have the same"
            ),
            Self::Before { message } => write!(f, "{message} (before the ensemble was saved)"),
            Self::Cancelled { done, of } => {
                write!(f, "the sweep was cancelled after {done} of {of} members")
            }
            Self::Panicked { message } => write!(f, "a closure panicked: {message}"),
        }
    }
}

impl core::error::Error for SweepError {
    /// Returns the error of the member.
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Member { error, .. } => Some(error.as_ref()),
            _ => None,
        }
    }
}
