//! Errors of saved runs.

use alloc::boxed::Box;
use core::fmt::{self, Display, Formatter};

/// Why a saved run cannot be read or gone on with.
#[derive(Clone, PartialEq)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The file cannot be read or written.
    #[non_exhaustive]
    File {
        /// Its path.
        path: Box<str>,
        /// The system's message.
        message: Box<str>,
    },
    /// These bytes are no saved run.
    #[non_exhaustive]
    Foreign,
    /// It was saved by a newer version of this library.
    #[non_exhaustive]
    Newer {
        /// The version of the file.
        version: u64,
        /// The newest version that can be read.
        readable: u64,
    },
    /// It was saved by an older version of this library, whose steps have other bits.
    #[non_exhaustive]
    Older {
        /// The version of the file.
        version: u64,
        /// The version that can be read.
        readable: u64,
    },
    /// The bytes are not those that were written.
    #[non_exhaustive]
    Damaged {
        /// The part that does not fit.
        reason: Box<str>,
    },
    /// It is the run of something else.
    #[non_exhaustive]
    Other {
        /// `system`, `parameter`, `scheme`, `scalar`, `observer`.
        what: Box<str>,
        /// That of the file.
        saved: Box<str>,
        /// That of the program.
        given: Box<str>,
    },
}

impl CheckpointError {
    /// Returns the error of bytes that are not those that were written.
    pub(crate) fn damaged(reason: &str) -> Self {
        CheckpointError::Damaged {
            reason: reason.into(),
        }
    }
}

impl Display for CheckpointError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::File { path, message } => write!(f, "`{path}`: {message}"),
            Self::Foreign => f.write_str("this is no saved run: it does not begin as one"),
            Self::Newer { version, readable } => write!(
                f,
                "the run was saved in format {version}, this version reads up to {readable}: update it"
            ),
            Self::Older { version, readable } => write!(
                f,
                "the run was saved in format {version}, this version reads format {readable} alone, \
                 since its steps have other bits: go on with the version that saved it, or begin a \
                 new run from its last state"
            ),
            Self::Damaged { reason } => write!(f, "the saved run is damaged: {reason}"),
            Self::Other { what, saved, given } => write!(
                f,
                "the saved run has another {what}: saved `{saved}`, given `{given}`"
            ),
        }
    }
}

impl core::error::Error for CheckpointError {}
