//! Errors by phase: each phase of a study has an enum with the values that went wrong, and [`Error`] contains them all.
//!
//! | phase | when it is met |
//! |---|---|
//! | [`InputError`] | a system, a state or coordinates are made: lengths, extents, sizes, NaN |
//! | [`KnotError`] | a spline or a grid is made from data |
//! | [`StartError`] | a run begins or changes: the step, the start, the values of H there, what the scheme requires |
//! | [`StepError`] | a step fails: a result that is not finite, equations that were not solved |
//! | [`TimeError`] | a run is sent to a time that its steps do not lead to |
//! | [`ObservableError`] | a monitor, an invariant or an event is named |
//! | [`SearchError`] | a start or a periodic orbit is sought |
//! | [`SweepError`] | an ensemble or a sweep is made, advanced or stopped; an error of one member |
//! | [`ShardError`] | a part of a sweep is chosen |
//! | [`CheckpointError`] | a run is saved or resumed |
//! | [`TableError`] | columns and rows of a table are named or filled |
//! | `StoreError` | a Zarr store is written or read (feature `std`) |
//!
//! Every function of the library that fails returns `Error` or one of these, so `?` works in a function that returns
//! `Result<_, Error>`. The message of an error has the values and the remedy. `Debug` writes the message too, because that is
//! what `fn main() -> Result<(), Error>` shows.
//!
//! A program that handles some errors and returns the others matches on the phase. This one skips starts that are refused,
//! and stops at a step that fails:
//! ```
//! use hamiltonian::errors::StepError;
//! use hamiltonian::prelude::*;
//!
//! hamiltonian! {
//!     /// A hill on which orbits reach infinity in a finite time.
//!     pub struct Hill {}
//!     H(q; p) = p^2/2 - q^4
//! }
//!
//! /// How an orbit ends.
//! #[derive(Debug, PartialEq)]
//! enum Outcome {
//!     Refused,
//!     Escapes(f64),
//!     Stays,
//! }
//!
//! fn outcome(q: f64) -> Result<Outcome, Error> {
//!     let start = State::new([q], [0.0]);
//!     let mut run = match Integrator::new(&Hill {}, StormerVerlet::default(), start, 1e-3) {
//!         Err(Error::Start(refused)) => {
//!             println!("{refused}"); // the start is not finite: t = 0, q = [NaN], p = [0.0]
//!             return Ok(Outcome::Refused);
//!         }
//!         made => made?, // other phases
//!     };
//!     match run.advance(2_000) {
//!         Err(Error::Step(StepError::NotFinite { time, .. })) => Ok(Outcome::Escapes(time)),
//!         Err(other) => Err(other),
//!         Ok(_) => Ok(Outcome::Stays),
//!     }
//! }
//!
//! assert_eq!(outcome(f64::NAN)?, Outcome::Refused);
//! assert_eq!(outcome(0.1)?, Outcome::Stays);
//! let Outcome::Escapes(time) = outcome(1.0)? else { panic!() };
//! assert!((time - 0.927).abs() < 0.02);
//! # Ok::<(), Error>(())
//! ```
//!
//! A pattern of a variant ends in `..`, also if the variant has no fields (`SweepError::NoMembers { .. }`): later versions
//! may add fields. A field of one name has one type in all variants. All texts are `Box<str>`, all lists boxed slices, and
//! numbers of a run are `f64` whatever its scalar.

mod checkpoint;
mod input;
mod knots;
mod nearest;
mod observable;
mod search;
mod shard;
mod start;
mod step;
#[cfg(feature = "std")]
mod store;
mod sweep;
mod table;
mod time;
mod words;

pub use checkpoint::CheckpointError;
pub use input::InputError;
pub use knots::KnotError;
pub use observable::ObservableError;
pub use search::SearchError;
pub use shard::ShardError;
pub use start::StartError;
pub use step::StepError;
#[cfg(feature = "std")]
pub use store::StoreError;
pub use sweep::SweepError;
pub use table::TableError;
pub use time::TimeError;

use alloc::boxed::Box;
use core::fmt::{self, Debug, Display, Formatter};
pub(crate) use words::Known;

/// An error of any [phase](self). Memory is allocated only when one happened.
#[derive(PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// A system, a state or coordinates cannot be made.
    Input(InputError),
    /// No spline or grid passes through the data.
    Knots(KnotError),
    /// A run, or a change of it, is refused before a step is made.
    Start(StartError),
    /// A step failed. The run stays at the state before that step.
    Step(StepError),
    /// No steps lead to a time.
    Time(TimeError),
    /// An observable does not exist or does not fit its use.
    Observable(ObservableError),
    /// A search found nothing, or nothing that is accepted.
    Search(SearchError),
    /// An ensemble or a sweep is refused or was stopped, or a member of it failed.
    Sweep(SweepError),
    /// A part of a sweep does not exist, or the environment does not determine it.
    Shard(ShardError),
    /// A saved run cannot be written, read or continued.
    Checkpoint(CheckpointError),
    /// A column does not exist, or a row does not fit.
    Table(TableError),
    /// A store cannot be written or read, or is that of another sweep.
    #[cfg(feature = "std")]
    Store(StoreError),
    /// A file or another writer failed.
    #[cfg(feature = "std")]
    #[non_exhaustive]
    Io {
        /// The kind of the failure.
        kind: std::io::ErrorKind,
        /// The message of the operating system or the writer.
        message: Box<str>,
    },
    /// An error of a user's observer or scheme, made by [`Error::other`].
    #[non_exhaustive]
    Other {
        /// Its message.
        message: Box<str>,
    },
}

impl Error {
    /// Makes an error of an observer or a scheme of your own from its message.
    ///
    /// ```
    /// use hamiltonian::prelude::*;
    ///
    /// let error = Error::other("the particle left the box");
    /// assert_eq!(error.to_string(), "the particle left the box");
    /// ```
    pub fn other(message: impl Into<Box<str>>) -> Self {
        Error::Other {
            message: message.into(),
        }
    }
}

/// Makes each phase an error that becomes [`Error`], and whose `Debug` is its message. The message of `Error` is that of
/// the phase.
macro_rules! phases {
    ($($(#[$with:meta])* $Variant:ident($Phase:ident))*) => {
        $(
            $(#[$with])*
            impl From<$Phase> for Error {
                fn from(error: $Phase) -> Self {
                    Error::$Variant(error)
                }
            }

            $(#[$with])*
            impl Debug for $Phase {
                /// Writes the message, because that is what `main` shows.
                fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
                    Display::fmt(self, f)
                }
            }
        )*

        /// Not derived: a derived copy is inlined, and compiled anew in each program.
        impl Clone for Error {
            fn clone(&self) -> Self {
                match self {
                    $($(#[$with])* Error::$Variant(error) => Error::$Variant(error.clone()),)*
                    #[cfg(feature = "std")]
                    Error::Io { kind, message } => Error::Io {
                        kind: *kind,
                        message: message.clone(),
                    },
                    Error::Other { message } => Error::Other {
                        message: message.clone(),
                    },
                }
            }
        }

        impl Display for Error {
            fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
                match self {
                    $($(#[$with])* Error::$Variant(error) => Display::fmt(error, f),)*
                    #[cfg(feature = "std")]
                    Error::Io { message, .. } => f.write_str(message),
                    Error::Other { message } => f.write_str(message),
                }
            }
        }

        impl core::error::Error for Error {
            /// Returns the cause of the phase's error. The phase itself has the same message.
            fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
                match self {
                    $($(#[$with])* Error::$Variant(error) => error.source(),)*
                    #[cfg(feature = "std")]
                    Error::Io { .. } => None,
                    Error::Other { .. } => None,
                }
            }
        }
    };
}

phases! {
    Input(InputError)
    Knots(KnotError)
    Start(StartError)
    Step(StepError)
    Time(TimeError)
    Observable(ObservableError)
    Search(SearchError)
    Sweep(SweepError)
    Shard(ShardError)
    Checkpoint(CheckpointError)
    Table(TableError)
    #[cfg(feature = "std")]
    Store(StoreError)
}

#[cfg(feature = "std")]
impl From<std::io::Error> for Error {
    /// Keeps the kind and the message, by which two errors are compared.
    fn from(error: std::io::Error) -> Self {
        Error::Io {
            kind: error.kind(),
            message: alloc::format!("{error}").into(),
        }
    }
}

/// Writes the message, because that is what `fn main() -> Result<(), Error>` shows.
impl Debug for Error {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        Display::fmt(self, f)
    }
}
