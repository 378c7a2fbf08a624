//! Errors of times that a run is sent to.

use super::words::Number;
use alloc::boxed::Box;
use core::fmt::{self, Display, Formatter};

/// Why no steps lead to a time.
#[derive(Clone, PartialEq)]
#[non_exhaustive]
pub enum TimeError {
    /// Whole steps from the current time do not meet the target.
    #[non_exhaustive]
    OffGrid {
        /// The name of the run's time: `t`, or that of a time-transformed system (`dt = g*ds`).
        clock: Box<str>,
        /// The target time.
        target: f64,
        /// The last reachable time that is not beyond it.
        before: f64,
        /// The first reachable time beyond it.
        after: f64,
    },
    /// No number of steps leads to the target: it is NaN, infinite, or 2⁵³ steps ahead and more.
    #[non_exhaustive]
    Unreachable {
        /// The name of the run's time: `t`, or that of a time-transformed system (`dt = g*ds`).
        clock: Box<str>,
        /// The target time.
        target: f64,
    },
    /// The target lies behind the run.
    #[non_exhaustive]
    Behind {
        /// The name of the run's time: `t`, or that of a time-transformed system (`dt = g*ds`).
        clock: Box<str>,
        /// The target time.
        target: f64,
        /// The current time.
        now: f64,
    },
    /// The steps of the scheme vary in time, so no number of them is known to lead to a time.
    #[non_exhaustive]
    Uneven,
    /// The target is more than one step from the current time.
    #[non_exhaustive]
    Far {
        /// The name of the run's time: `t`, or that of a time-transformed system (`dt = g*ds`).
        clock: Box<str>,
        /// The target time.
        target: f64,
        /// One step back from the current time.
        from: f64,
        /// One step on.
        to: f64,
    },
}

impl Display for TimeError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::OffGrid {
                clock,
                target,
                before,
                after,
            } => write!(
                f,
                "{clock} = {} is no whole number of steps ahead: the nearest times are {} and {}; \
                 `advance_until` goes to any time",
                Number(*target),
                Number(*before),
                Number(*after)
            ),
            Self::Unreachable { clock, target } => write!(
                f,
                "{clock} = {} cannot be reached: give a finite time, less than 2^53 steps ahead",
                Number(*target)
            ),
            Self::Behind { clock, target, now } => write!(
                f,
                "{clock} = {} lies behind the run, which is at {clock} = {}: a step of the other \
                 sign leads there",
                Number(*target),
                Number(*now)
            ),
            Self::Uneven => {
                f.write_str("steps of this scheme vary in time: `advance_until` goes to any time")
            }
            Self::Far {
                clock,
                target,
                from,
                to,
            } => write!(
                f,
                "{clock} = {} is more than one step from the present: choose a time from {} \
                 to {}",
                Number(*target),
                Number(*from),
                Number(*to)
            ),
        }
    }
}

impl core::error::Error for TimeError {}
