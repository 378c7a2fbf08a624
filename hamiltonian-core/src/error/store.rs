//! Errors of stores.

use super::Error;
use core::fmt::{self, Display, Formatter};

/// An error of a store.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum StoreError {
    /// A layout that no store can have.
    Layout {
        /// The part that does not fit.
        fact: String,
        /// The remedy.
        remedy: &'static str,
    },
    /// The directory holds something else.
    Foreign {
        /// The directory.
        path: String,
        /// A name in the directory that no store has.
        found: String,
    },
    /// The store belongs to another sweep.
    Other {
        /// The file that differs.
        path: String,
        /// The first line of it that differs.
        saved: String,
        /// That line for this sweep.
        given: String,
    },
    /// The chunk was written with other members.
    Members {
        /// The store.
        path: String,
        /// The number of the chunk.
        chunk: u64,
    },
    /// A file of the store differs from what was written.
    Damaged {
        /// The file.
        path: String,
        /// Its length.
        found: u64,
        /// Its length as it was written.
        expected: u64,
    },
    /// A chunk does not have the shape of the layout.
    Shape {
        /// The number of the chunk.
        chunk: u64,
        /// The array, or `chunk` for a number beyond the last chunk.
        array: String,
        /// The number of values given.
        found: u64,
        /// The number the layout has.
        expected: u64,
    },
    /// The disk is full, or a quota is used up. Chunks written before are intact.
    Full {
        /// The store.
        path: String,
    },
    /// A file cannot be read or written.
    File {
        /// Its path.
        path: String,
        /// The system's message.
        message: String,
    },
}

impl Display for StoreError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Layout { fact, remedy } => write!(f, "{fact}\nhelp: {remedy}"),
            Self::Foreign { path, found } => write!(
                f,
                "`{path}` is no store: it has `{found}` in it\nhelp: give a path of its own"
            ),
            Self::Other { path, saved, given } => write!(
                f,
                "`{path}` is the store of another sweep: it says `{saved}`, and this sweep \
                 `{given}`\n\
                 help: give another path, or remove the store"
            ),
            Self::Members { path, chunk } => write!(
                f,
                "chunk {chunk} of `{path}` was made from other members: its first one had another \
                 system or another start\n\
                 help: give another path, or make the members as they were made"
            ),
            Self::Damaged {
                path,
                found,
                expected,
            } => write!(
                f,
                "`{path}` is damaged: it has {found} bytes, and must have {expected}\n\
                 help: remove it"
            ),
            Self::Shape {
                chunk,
                array,
                found,
                expected,
            } => write!(
                f,
                "chunk {chunk}: `{array}` has {found} values, and must have {expected}"
            ),
            Self::Full { path } => write!(
                f,
                "`{path}` cannot be written: no space is left\n\
                 help: make space and run the sweep again; chunks that exist are skipped"
            ),
            Self::File { path, message } => write!(f, "`{path}`: {message}"),
        }
    }
}

impl core::error::Error for StoreError {}

impl From<StoreError> for Error {
    fn from(error: StoreError) -> Self {
        Error::Store(error)
    }
}
