//! Errors of tables.

use super::nearest::nearest;
use super::words::Known;
use alloc::borrow::ToOwned;
use alloc::string::String;
use alloc::vec::Vec;

/// An error of a table.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// There is no column of that name.
    #[error("there is no column `{name}`{}", Remedy(.nearest, .known))]
    Unknown {
        /// The name given.
        name: String,
        /// The known name nearest to it, if one is near.
        nearest: Option<String>,
        /// All known names.
        known: Vec<String>,
    },
    /// Two columns have the same name.
    #[error("two columns have the name `{name}`\nhelp: give each column a name of its own")]
    Twice {
        /// The name.
        name: String,
    },
    /// A row has too few or too many values.
    #[error("a row has {found} values, and the table {columns} columns")]
    Width {
        /// The number of columns.
        columns: usize,
        /// The number of values.
        found: usize,
    },
    /// A value of the index column is not a whole number.
    #[error("the index `{name}` is {found:?}, and must be a whole number of at most 2^53")]
    Index {
        /// The name of the index column.
        name: String,
        /// The value.
        found: f64,
    },
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

/// The nearest name, or all names.
struct Remedy<'a>(&'a Option<String>, &'a [String]);

impl core::fmt::Display for Remedy<'_> {
    #[inline]
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Remedy(Some(nearest), _) => write!(f, "\nhelp: did you mean `{nearest}`?"),
            Remedy(None, []) => write!(f, "\nhelp: the table has no columns"),
            Remedy(None, known) => Known("the columns are", known).fmt(f),
        }
    }
}
