//! Errors of shards.

use super::Error;
use alloc::string::String;
use core::fmt::{self, Display, Formatter};

/// A part of a sweep that does not exist, or that the environment does not determine.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum ShardError {
    /// There is no part of that number.
    Range {
        /// The number of the part, counted from 0.
        index: u64,
        /// The number of parts.
        count: u64,
        /// The variable that holds the number of the part, if the environment gives it.
        variable: Option<&'static str>,
    },
    /// A text or a variable does not have the required form.
    Form {
        /// The variable, if the environment gives it.
        variable: Option<&'static str>,
        /// Its text.
        text: String,
        /// The form it must have.
        expected: &'static str,
    },
    /// A variable is set without another one that belongs to it.
    Missing {
        /// The variable that is set.
        variable: &'static str,
        /// The variable that is missing.
        missing: &'static str,
        /// The remedy.
        remedy: &'static str,
    },
    /// Two variables contradict each other.
    Contradiction {
        /// A variable with its value.
        one: String,
        /// Another one with its value.
        other: String,
        /// The reason why the two do not fit.
        reason: &'static str,
    },
}

impl Display for ShardError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Range {
                index,
                count,
                variable,
            } => write!(
                f,
                "shard {index}/{count}{} does not exist\nhelp: {}",
                FromVariable(variable),
                ValidShards(*count)
            ),
            Self::Form {
                variable,
                text,
                expected,
            } => write!(f, "{}`{text}`, and must be {expected}", Named(variable)),
            Self::Missing {
                variable,
                missing,
                remedy,
            } => write!(
                f,
                "`{variable}` is set, but `{missing}` is not\nhelp: {remedy}"
            ),
            Self::Contradiction { one, other, reason } => write!(
                f,
                "`{one}` contradicts `{other}`: {reason}\n\
                 help: set `HAMILTONIAN_SHARD=k/n` for each process"
            ),
        }
    }
}

impl core::error::Error for ShardError {}

impl From<ShardError> for Error {
    fn from(error: ShardError) -> Self {
        Error::Shard(error)
    }
}

/// ` (from …)` for a variable.
struct FromVariable<'a>(&'a Option<&'static str>);

impl Display for FromVariable<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(variable) => write!(f, " (from `{variable}`)"),
            None => Ok(()),
        }
    }
}

/// `… is ` for a variable.
struct Named<'a>(&'a Option<&'static str>);

impl Display for Named<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(variable) => write!(f, "`{variable}` is "),
            None => write!(f, "the shard is "),
        }
    }
}

/// The shards that exist.
struct ValidShards(u64);

impl Display for ValidShards {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.0 {
            0 => write!(f, "a sweep has at least one shard, 0/1"),
            1 => write!(f, "the only shard is 0/1"),
            n => write!(f, "shards of {n} are 0/{n} to {}/{n}", n - 1),
        }
    }
}
