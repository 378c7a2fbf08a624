//! Errors of shards.

use alloc::boxed::Box;
use core::fmt::{self, Display, Formatter};

/// A part of a sweep that does not exist, or that the environment does not determine.
#[derive(Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum ShardError {
    /// There is no part of that number.
    #[non_exhaustive]
    Range {
        /// The number of the part, counted from 0.
        shard: u64,
        /// The number of parts.
        shards: u64,
        /// The variable that holds the number of the part, if the environment gives it.
        variable: Option<Box<str>>,
    },
    /// A text or a variable does not have the required form.
    #[non_exhaustive]
    Form {
        /// The variable, if the environment gives it.
        variable: Option<Box<str>>,
        /// Its text.
        text: Box<str>,
        /// The form it must have.
        form: Box<str>,
    },
    /// A variable is set without another one that belongs to it.
    #[non_exhaustive]
    Missing {
        /// The variable that is set.
        present: Box<str>,
        /// The variable that is missing.
        missing: Box<str>,
        /// The remedy.
        remedy: Box<str>,
    },
    /// Two variables contradict each other.
    #[non_exhaustive]
    Contradiction {
        /// A variable with its value.
        one: Box<str>,
        /// Another one with its value.
        other: Box<str>,
        /// The reason why the two do not fit.
        reason: Box<str>,
    },
}

impl Display for ShardError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Range {
                shard,
                shards,
                variable,
            } => write!(
                f,
                "shard {shard}/{shards}{} does not exist\nhelp: {}",
                FromVariable(variable),
                ValidShards(*shards)
            ),
            Self::Form {
                variable,
                text,
                form,
            } => write!(f, "{}`{text}`, and must be {form}", Named(variable)),
            Self::Missing {
                present,
                missing,
                remedy,
            } => write!(
                f,
                "`{present}` is set, but `{missing}` is not\nhelp: {remedy}"
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

/// ` (from …)` for a variable.
struct FromVariable<'a>(&'a Option<Box<str>>);

impl Display for FromVariable<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(variable) => write!(f, " (from `{variable}`)"),
            None => Ok(()),
        }
    }
}

/// `… is ` for a variable.
struct Named<'a>(&'a Option<Box<str>>);

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
