//! Errors of knots and of the values at them.

use super::Error;
use core::fmt::{self, Display, Formatter};

/// Data that a [`Spline`](crate::systems::function::Spline) or a [`Grid`](crate::systems::function::Grid) cannot pass through.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum KnotError {
    /// There are too few knots.
    TooFew {
        /// The least number of knots, in each direction of a grid.
        needed: usize,
        /// The number given.
        found: usize,
    },
    /// The numbers of knots and of values differ.
    Lengths {
        /// The number of knots.
        knots: usize,
        /// The number of values.
        values: usize,
    },
    /// A knot, a value, a slope, an origin or a spacing is infinite or NaN.
    NotFinite {
        /// The quantity: "knot", "value", "slope", "origin" or "spacing".
        what: &'static str,
        /// Its number, from 0 on.
        at: usize,
        /// The number given.
        found: f64,
    },
    /// A knot is not above the knot before it.
    NotIncreasing {
        /// The number of the knot, from 1 on.
        at: usize,
        /// The knot before it.
        before: f64,
        /// The knot.
        found: f64,
    },
    /// A spacing is not positive.
    Spacing {
        /// The direction, 0 or 1.
        at: usize,
        /// The spacing given.
        found: f64,
    },
    /// The first and the last value of a periodic function differ.
    NotPeriodic {
        /// The first value.
        first: f64,
        /// The last value.
        last: f64,
    },
}

impl Display for KnotError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFew { needed, found } => {
                write!(f, "{found} knots are too few: at least {needed} are needed")
            }
            Self::Lengths { knots, values } => write!(f, "{knots} knots have {values} values"),
            Self::NotFinite { what, at, found } => {
                write!(f, "{what} {at} is {found}, and must be finite")
            }
            Self::NotIncreasing { at, before, found } => write!(
                f,
                "knot {at} is {found}, and must be above knot {}, which is {before}",
                at - 1
            ),
            Self::Spacing { at, found } => {
                write!(f, "spacing {at} is {found}, and must be positive")
            }
            Self::NotPeriodic { first, last } => write!(
                f,
                "a periodic function begins and ends with the same value: the first is {first}, \
                 the last {last}"
            ),
        }
    }
}

impl core::error::Error for KnotError {}

impl From<KnotError> for Error {
    fn from(error: KnotError) -> Self {
        Error::Knots(error)
    }
}

impl KnotError {
    /// Returns an error if one of the numbers is not finite.
    pub(crate) fn check_finite(what: &'static str, numbers: &[f64]) -> Result<(), KnotError> {
        match numbers.iter().position(|number| !number.is_finite()) {
            None => Ok(()),
            Some(at) => Err(KnotError::NotFinite {
                what,
                at,
                found: numbers[at],
            }),
        }
    }

    /// Returns an error if there are fewer than `needed` knots.
    pub(crate) fn check_count(needed: usize, found: usize) -> Result<(), KnotError> {
        match found >= needed {
            true => Ok(()),
            false => Err(KnotError::TooFew { needed, found }),
        }
    }
}
