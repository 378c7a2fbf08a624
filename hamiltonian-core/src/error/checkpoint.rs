//! Errors of saved runs.

use super::Error;
use alloc::string::String;
use core::fmt::{self, Display, Formatter};

/// Why a saved run cannot be read or gone on with.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The file cannot be read or written.
    File {
        /// Its path.
        path: String,
        /// The system's message.
        message: String,
    },
    /// These bytes are no saved run.
    Foreign,
    /// It was saved by a newer version of this library.
    Newer {
        /// The version of the file.
        found: u64,
        /// The newest version that can be read.
        known: u64,
    },
    /// It was saved by an older version of this library, whose steps have other bits.
    Older {
        /// The version of the file.
        found: u64,
        /// The version that can be read.
        known: u64,
    },
    /// The bytes are not those that were written.
    Damaged {
        /// The part that does not fit.
        reason: &'static str,
    },
    /// It is the run of something else.
    Other {
        /// `system`, `parameter`, `scheme`, `scalar`, `observer`.
        what: &'static str,
        /// That of the file.
        saved: String,
        /// That of the program.
        given: String,
    },
}

impl Display for CheckpointError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::File { path, message } => write!(f, "`{path}`: {message}"),
            Self::Foreign => f.write_str("this is no saved run: it does not begin as one"),
            Self::Newer { found, known } => write!(
                f,
                "the run was saved in format {found}, this version reads up to {known}: update it"
            ),
            Self::Older { found, known } => write!(
                f,
                "the run was saved in format {found}, this version reads format {known} alone, \
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

impl From<CheckpointError> for Error {
    fn from(error: CheckpointError) -> Self {
        Error::Checkpoint(error)
    }
}
