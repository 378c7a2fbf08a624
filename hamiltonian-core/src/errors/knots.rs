//! Errors of knots and of the values at them.

use alloc::boxed::Box;
use core::fmt::{self, Display, Formatter};

/// Data that a [`Spline`](crate::systems::function::Spline) or a [`Grid`](crate::systems::function::Grid) cannot pass through.
#[derive(Clone, PartialEq)]
#[non_exhaustive]
pub enum KnotError {
    /// There are too few knots.
    #[non_exhaustive]
    TooFew {
        /// The least number of knots, in each direction of a grid.
        needed: usize,
        /// The number given.
        found: usize,
    },
    /// The numbers of knots and of values differ.
    #[non_exhaustive]
    Lengths {
        /// The number of knots.
        knots: usize,
        /// The number of values.
        values: usize,
    },
    /// A knot, a value, a slope, an origin or a spacing is infinite or NaN.
    #[non_exhaustive]
    NotFinite {
        /// The quantity: "knot", "value", "slope", "origin" or "spacing".
        what: Box<str>,
        /// Its number, from 0 on.
        index: usize,
        /// The number given.
        value: f64,
    },
    /// A knot is not above the knot before it.
    #[non_exhaustive]
    NotIncreasing {
        /// The number of the knot, from 1 on.
        index: usize,
        /// The knot before it.
        before: f64,
        /// The knot.
        value: f64,
    },
    /// A spacing is not positive.
    #[non_exhaustive]
    Spacing {
        /// The direction, 0 or 1.
        index: usize,
        /// The spacing given.
        value: f64,
    },
    /// The first and the last value of a periodic function differ.
    #[non_exhaustive]
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
            Self::NotFinite { what, index, value } => {
                write!(f, "{what} {index} is {value}, and must be finite")
            }
            Self::NotIncreasing {
                index,
                before,
                value,
            } => write!(
                f,
                "knot {index} is {value}, and must be above knot {}, which is {before}",
                index - 1
            ),
            Self::Spacing { index, value } => {
                write!(f, "spacing {index} is {value}, and must be positive")
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

impl KnotError {
    /// Returns an error if one of the numbers is not finite.
    pub(crate) fn check_finite(what: &str, numbers: &[f64]) -> Result<(), KnotError> {
        match numbers.iter().position(|number| !number.is_finite()) {
            None => Ok(()),
            Some(index) => Err(KnotError::NotFinite {
                what: what.into(),
                index,
                value: numbers[index],
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
