//! Errors of stores.

use alloc::boxed::Box;
use core::fmt::{self, Display, Formatter};

/// An error of a store.
#[derive(Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum StoreError {
    /// A layout that no store can have.
    #[non_exhaustive]
    Layout {
        /// The part that does not fit.
        fact: Box<str>,
        /// The remedy.
        remedy: Box<str>,
    },
    /// The directory holds something else.
    #[non_exhaustive]
    Foreign {
        /// The directory.
        path: Box<str>,
        /// A name in the directory that no store has.
        entry: Box<str>,
    },
    /// The store belongs to another sweep.
    #[non_exhaustive]
    Other {
        /// The file that differs.
        path: Box<str>,
        /// The first line of it that differs.
        saved: Box<str>,
        /// That line for this sweep.
        given: Box<str>,
    },
    /// The chunk was written with other members.
    #[non_exhaustive]
    Members {
        /// The store.
        path: Box<str>,
        /// The number of the chunk.
        chunk: u64,
    },
    /// A file of the store differs from what was written.
    #[non_exhaustive]
    Damaged {
        /// The file.
        path: Box<str>,
        /// Its length in bytes.
        found: usize,
        /// Its length as it was written.
        expected: usize,
    },
    /// A chunk does not have the shape of the layout.
    #[non_exhaustive]
    Shape {
        /// The number of the chunk.
        chunk: u64,
        /// The array.
        array: Box<str>,
        /// The number of values given.
        found: usize,
        /// The number the layout has.
        expected: usize,
    },
    /// The layout has no chunk of this number.
    #[non_exhaustive]
    NoChunk {
        /// The number of the chunk.
        chunk: u64,
        /// The number of chunks.
        chunks: u64,
    },
    /// The disk is full, or a quota is used up. Chunks written before are intact.
    #[non_exhaustive]
    Full {
        /// The store.
        path: Box<str>,
    },
    /// A file cannot be read or written.
    #[non_exhaustive]
    File {
        /// Its path.
        path: Box<str>,
        /// The system's message.
        message: Box<str>,
    },
}

impl StoreError {
    /// Returns the error of a layout that no store can have.
    pub(crate) fn layout(fact: String, remedy: &str) -> Self {
        StoreError::Layout {
            fact: fact.into(),
            remedy: remedy.into(),
        }
    }
}

impl Display for StoreError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Layout { fact, remedy } => write!(f, "{fact}\nhelp: {remedy}"),
            Self::Foreign { path, entry } => write!(
                f,
                "`{path}` is no store: it has `{entry}` in it\nhelp: give a path of its own"
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
            Self::NoChunk { chunk, chunks } => write!(
                f,
                "there is no chunk {chunk}: the layout has {chunks}, and the last is chunk {}",
                chunks.saturating_sub(1)
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
