//! Errors of tables.

use super::Error;
use super::nearest::nearest;
use super::words::Known;
use alloc::borrow::ToOwned;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt::{self, Display, Formatter};

/// An error of a table.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum TableError {
    /// There is no column of that name.
    Unknown {
        /// The name given.
        name: String,
        /// The known name nearest to it, if one is near.
        nearest: Option<String>,
        /// All known names.
        known: Vec<String>,
    },
    /// Two columns have the same name.
    Twice {
        /// The name.
        name: String,
    },
    /// A row has too few or too many values.
    Width {
        /// The number of columns.
        columns: usize,
        /// The number of values.
        found: usize,
    },
    /// A value of the index column is not a whole number.
    Index {
        /// The name of the index column.
        name: String,
        /// The value.
        found: f64,
    },
}

impl Display for TableError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown {
                name,
                nearest,
                known,
            } => write!(
                f,
                "there is no column `{name}`{}",
                ColumnRemedy(nearest, known)
            ),
            Self::Twice { name } => write!(
                f,
                "two columns have the name `{name}`\nhelp: give each column a name of its own"
            ),
            Self::Width { columns, found } => write!(
                f,
                "a row has {found} values, and the table {columns} columns"
            ),
            Self::Index { name, found } => write!(
                f,
                "the index `{name}` is {found:?}, and must be a whole number of at most 2^53"
            ),
        }
    }
}

impl core::error::Error for TableError {}

impl From<TableError> for Error {
    fn from(error: TableError) -> Self {
        Error::Table(error)
    }
}

impl TableError {
    /// The error for a name that is not among `known`.
    #[inline]
    pub(crate) fn unknown(name: &str, known: &[String]) -> Self {
        TableError::Unknown {
            name: name.to_owned(),
            nearest: nearest(name, known.iter().map(String::as_str)).map(ToOwned::to_owned),
            known: known.to_vec(),
        }
    }
}

/// The remedy for an unknown column: the nearest name, or all names.
struct ColumnRemedy<'a>(&'a Option<String>, &'a [String]);

impl Display for ColumnRemedy<'_> {
    #[inline]
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            ColumnRemedy(Some(nearest), _) => write!(f, "\nhelp: did you mean `{nearest}`?"),
            ColumnRemedy(None, []) => write!(f, "\nhelp: the table has no columns"),
            ColumnRemedy(None, known) => Known("the columns are", known).fmt(f),
        }
    }
}
