//! Why a definition is not made a system, and why a run by name fails.

use crate::diagnostics::Place;
use hamiltonian_core::errors::{Error, InputError};
use std::fmt::{self, Display, Formatter};

/// Why [`Definition::system`](crate::Definition::system) makes no system.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum SystemError {
    /// The definition has something that systems at run time do not have, or not yet.
    #[non_exhaustive]
    NotCarried {
        /// The feature.
        feature: String,
        /// Its place.
        place: Place,
    },
    /// A value has the name of no parameter and of no size.
    #[non_exhaustive]
    Unknown {
        /// The name.
        name: String,
        /// The names that the definition declares.
        known: Vec<String>,
    },
    /// A parameter without a default, or a size, has no value.
    #[non_exhaustive]
    NoValue {
        /// Its name.
        name: String,
    },
    /// A size is negative or not whole, or a list has the place of a number or of a size.
    #[non_exhaustive]
    NoNumber {
        /// The name of the parameter or size.
        name: String,
        /// What is expected: `a number`, `a size`.
        expected: &'static str,
    },
    /// A function has the place of a number or of a list, or the other way round.
    #[non_exhaustive]
    NoFunction {
        /// The name of the parameter.
        name: String,
        /// The number of arguments that the function must have; 0 if the parameter is no function.
        arguments: usize,
    },
    /// A list has another number of elements than the array that is declared.
    #[non_exhaustive]
    Length {
        /// The name of the array.
        name: String,
        /// The number of its elements.
        expected: usize,
        /// The number of elements given.
        found: usize,
    },
    /// An array has no element of this number.
    #[non_exhaustive]
    NoElement {
        /// Its name.
        name: String,
        /// The number of the element.
        element: usize,
        /// The number of elements.
        count: usize,
    },
    /// A parameter is NaN.
    #[non_exhaustive]
    NaN {
        /// Its name.
        name: String,
    },
    /// An array of these sizes does not fit into memory.
    #[non_exhaustive]
    Memory {
        /// Its name.
        name: String,
    },
    /// An index leaves its range for these sizes.
    Input(InputError),
}

impl Display for SystemError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotCarried { feature, place } => write!(
                f,
                "{place}: {feature}: systems defined at run time do not have this, compile the definition with \
                 `hamiltonian!`"
            ),
            Self::Unknown { name, known } if known.is_empty() => {
                write!(f, "there is no parameter `{name}`: the definition has none")
            }
            Self::Unknown { name, known } => write!(
                f,
                "there is no parameter or size `{name}`; there are `{}`",
                known.join("`, `")
            ),
            Self::NoValue { name } => {
                write!(f, "`{name}` has no default: give it a value")
            }
            Self::NoNumber { name, expected } => write!(f, "`{name}` must be {expected}"),
            Self::NoFunction { name, arguments } => match arguments {
                0 => write!(f, "`{name}` is a function, and must be a number or a list"),
                1 => write!(f, "`{name}` must be a function of one number: a `Spline`"),
                2 => write!(f, "`{name}` must be a function of two numbers: a `Grid`"),
                _ => write!(
                    f,
                    "`{name}` is a function of {arguments} numbers: systems defined at run time have \
                    functions of one and of two"
                ),
            },
            Self::Length {
                name,
                expected,
                found,
            } => write!(f, "`{name}` must have {expected} elements, found {found}"),
            Self::NoElement {
                name,
                element,
                count,
            } => write!(
                f,
                "`{name}` has {count} elements, numbered from 0: there is no element {element}"
            ),
            Self::NaN { name } => write!(f, "the parameter `{name}` is NaN, and must be a number"),
            Self::Memory { name } => write!(
                f,
                "`{name}` does not fit into memory: the sizes are too large"
            ),
            Self::Input(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for SystemError {}

impl From<InputError> for SystemError {
    fn from(error: InputError) -> SystemError {
        SystemError::Input(error)
    }
}

/// Why a run whose scheme has a name is not made, or does not advance.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum RunError {
    /// There is no scheme of this name.
    #[non_exhaustive]
    UnknownScheme {
        /// The name.
        name: String,
        /// The nearest name.
        nearest: Option<String>,
    },
    /// The scheme is not one of ensembles.
    #[non_exhaustive]
    SingleRuns {
        /// Its name.
        name: String,
    },
    /// A list of numbers has a wrong length.
    #[non_exhaustive]
    Length {
        /// What it has: `coordinates`, `momenta`, `systems`.
        what: &'static str,
        /// The length that is due.
        expected: usize,
        /// The length of the list.
        found: usize,
    },
    /// A column of a sweep has the name of nothing.
    #[non_exhaustive]
    UnknownColumn {
        /// Its name.
        name: String,
        /// The names that columns may have.
        known: Vec<String>,
    },
    /// Velocities are those of a Lagrangian, and the definition gives H.
    NoLagrangian,
    /// The cancel hook ended the call. The steps made so far are kept.
    Interrupted,
    /// The bytes are not those of a saved run.
    NotSaved,
    /// An error of the run.
    Run(Error),
}

impl Display for RunError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownScheme { name, nearest } => {
                write!(f, "there is no scheme `{name}`: ")?;
                match nearest {
                    Some(nearest) => write!(f, "the nearest name is `{nearest}`"),
                    None => f.write_str(
                        "`schemes()` lists all, for example `StormerVerlet` and `Gauss8`",
                    ),
                }
            }
            Self::SingleRuns { name } => write!(
                f,
                "ensembles do not have `{name}`: they have splittings, `ImplicitMidpoint` and `Gauss4`, and \
                 a `Run` for each member has every scheme"
            ),
            Self::Length {
                what,
                expected,
                found,
            } => write!(f, "there must be {expected} {what}, found {found}"),
            Self::UnknownColumn { name, known } => write!(
                f,
                "there is nothing named `{name}` to record; there are `{}`",
                known.join("`, `")
            ),
            Self::NoLagrangian => f.write_str(
                "velocities begin a Lagrangian, and the definition gives H: give momenta",
            ),
            Self::Interrupted => f.write_str("interrupted: the steps made so far are kept"),
            Self::NotSaved => f.write_str("these are not the bytes of a saved run"),
            Self::Run(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for RunError {}

impl From<Error> for RunError {
    fn from(error: Error) -> RunError {
        RunError::Run(error)
    }
}
