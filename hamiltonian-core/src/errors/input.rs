//! Errors of arrays, sizes and parameters.

use super::words::Number;
use alloc::boxed::Box;
use core::fmt::{self, Display, Formatter};

/// Why a system, a state or coordinates cannot be made: an array, a size or a parameter does not fit.
#[derive(Clone, PartialEq)]
#[non_exhaustive]
pub enum InputError {
    /// A vector, or an array of parameters, has the wrong number of components.
    #[non_exhaustive]
    Shape {
        /// The name of the coordinate, momentum or parameter.
        name: Box<str>,
        /// The number of components that the system requires.
        expected: usize,
        /// The number of components given.
        found: usize,
    },
    /// An axis of an array has the wrong extent.
    #[non_exhaustive]
    Extent {
        /// The name of the coordinate, momentum or parameter.
        name: Box<str>,
        /// The number of the axis, from 0 on.
        axis: usize,
        /// The extent that the system requires.
        expected: usize,
        /// The extent given.
        found: usize,
    },
    /// A list in nested lists has another length than its extent.
    #[non_exhaustive]
    Row {
        /// Its name with its place: `u[1]`.
        name: Box<str>,
        /// The extent.
        expected: usize,
        /// The number of elements given.
        found: usize,
    },
    /// An array of the sizes given does not fit into memory, or a product of sizes is larger than an `isize`.
    #[non_exhaustive]
    Memory {
        /// The name of the coordinate or parameter, or the product.
        name: Box<str>,
    },
    /// An index of the definition leaves its range for the sizes given.
    #[non_exhaustive]
    Index {
        /// The index as it is written.
        expression: Box<str>,
        /// A value that it takes.
        reached: i64,
        /// The extent; indices run from 0 to one less.
        extent: usize,
    },
    /// A sum of the definition begins below 0 for the sizes given.
    #[non_exhaustive]
    Range {
        /// The range as it is written.
        expression: Box<str>,
        /// Its first value.
        reached: i64,
    },
    /// A parameter is NaN.
    #[non_exhaustive]
    Parameter {
        /// Its name, with the place in an array: `m[1]`.
        name: Box<str>,
    },
    /// The partial sums m_0 + … + m_i of the masses of bodies are not all positive and finite.
    #[non_exhaustive]
    Masses {
        /// The last body of the sum.
        body: usize,
        /// The sum.
        sum: f64,
    },
}

impl Display for InputError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Shape {
                name,
                expected,
                found,
            } => write!(f, "`{name}` must have {expected} components, found {found}"),
            Self::Extent {
                name,
                axis,
                expected,
                found,
            } => write!(
                f,
                "axis {axis} of `{name}` must have the extent {expected}, found {found}"
            ),
            Self::Row {
                name,
                expected,
                found,
            } => write!(f, "`{name}` must have {expected} elements, found {found}"),
            Self::Memory { name } => write!(
                f,
                "`{name}` does not fit into memory: the sizes are too large"
            ),
            Self::Index {
                expression,
                reached,
                extent,
            } => write!(
                f,
                "`{expression}` reaches {reached}, but the extent is {extent}: the sizes do not fit"
            ),
            Self::Range {
                expression,
                reached,
            } => write!(
                f,
                "`{expression}` begins at {reached}, but ranges begin at 0 or above: the sizes do not fit"
            ),
            Self::Parameter { name } => {
                write!(f, "the parameter `{name}` is NaN, and must be a number")
            }
            Self::Masses { body, sum } => write!(
                f,
                "the masses of the bodies up to {body} add up to {}",
                Number(*sum)
            ),
        }
    }
}

impl core::error::Error for InputError {}
