//! Errors of tables.

use super::nearest::nearest;
use super::words::Known;
use alloc::boxed::Box;
use alloc::string::String;
use core::fmt::{self, Display, Formatter};

/// An error of a table.
#[derive(Clone, PartialEq)]
#[non_exhaustive]
pub enum TableError {
    /// There is no column of that name.
    #[non_exhaustive]
    Unknown {
        /// The name given.
        name: Box<str>,
        /// The known name nearest to it, if one is near.
        nearest: Option<Box<str>>,
        /// All known names.
        known: Box<[Box<str>]>,
    },
    /// Two columns have the same name.
    #[non_exhaustive]
    Twice {
        /// The name.
        name: Box<str>,
    },
    /// A row has too few or too many values.
    #[non_exhaustive]
    Width {
        /// The number of columns.
        columns: usize,
        /// The number of values.
        found: usize,
    },
    /// A value of the index column is not a whole number.
    #[non_exhaustive]
    Index {
        /// The name of the index column.
        name: Box<str>,
        /// The value.
        value: f64,
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
            Self::Index { name, value } => write!(
                f,
                "the index `{name}` is {value:?}, and must be a whole number of at most 2^53"
            ),
        }
    }
}

impl core::error::Error for TableError {}

impl TableError {
    /// The error for a name that is not among `known`.
    #[inline]
    pub(crate) fn unknown(name: &str, known: &[String]) -> Self {
        TableError::Unknown {
            name: name.into(),
            nearest: nearest(name, known.iter().map(String::as_str)).map(Into::into),
            known: known.iter().map(|known| known.as_str().into()).collect(),
        }
    }
}

/// The remedy for an unknown column: the nearest name, or all names.
struct ColumnRemedy<'a>(&'a Option<Box<str>>, &'a [Box<str>]);

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
