//! Errors of monitors, invariants and events.

use super::words::Known;
use alloc::boxed::Box;
use core::fmt::{self, Display, Formatter};

/// Why a monitor, an invariant or an event cannot be used.
#[derive(Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum ObservableError {
    /// The system declares no monitor, invariant or event of that name.
    #[non_exhaustive]
    Unknown {
        /// The unknown name.
        name: Box<str>,
        /// The system.
        system: Box<str>,
        /// The names that the system declares.
        known: Box<[Box<str>]>,
    },
    /// A monitor depends on time, where only q and p may occur.
    #[non_exhaustive]
    Timed {
        /// The monitor.
        name: Box<str>,
        /// The system.
        system: Box<str>,
    },
    /// An event cannot be located.
    #[non_exhaustive]
    Event {
        /// Its name.
        name: Box<str>,
        /// The reason, and a remedy.
        reason: Box<str>,
    },
    /// There is no observable of that index.
    #[non_exhaustive]
    Index {
        /// The index given.
        index: usize,
        /// The number of observables.
        count: usize,
    },
}

impl Display for ObservableError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown {
                name,
                system,
                known,
            } => write!(
                f,
                "`{system}` declares no monitor, invariant or event `{name}`{}",
                Known("it declares", known)
            ),
            Self::Timed { name, system } => write!(
                f,
                "the monitor `{name}` of `{system}` depends on time: only a definition with \
                 `dt = …*ds` may have time in its monitor function"
            ),
            Self::Event { name, reason } => {
                write!(f, "the event `{name}` cannot be located: {reason}")
            }
            Self::Index { index, count } => write!(
                f,
                "there is no observable {index}: the system declares {count}"
            ),
        }
    }
}

impl core::error::Error for ObservableError {}
