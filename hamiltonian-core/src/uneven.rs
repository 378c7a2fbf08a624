//! Nested lists whose parts have different lengths.
//!
//! Input: two of the parts. Output: the error that names one of them, once the extents are known.

use crate::error::Error;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// Two lists of different lengths at the same depth of nested lists: their places and lengths.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Uneven(pub(crate) [(Vec<usize>, usize); 2]);

impl Uneven {
    /// The error for coordinates of these extents: it names a part whose length differs.
    pub(crate) fn error(&self, name: &str, extents: &[usize]) -> Error {
        let [first, second] = &self.0;
        let expected = extents.get(first.0.len()).copied().unwrap_or_default();
        let (at, found) = if first.1 == expected { second } else { first };
        Error::Row {
            name: named(name, at),
            expected,
            found: *found,
        }
    }
}

/// The name of a row or an element: `u[1][2]`.
pub(crate) fn named(name: &str, at: &[usize]) -> String {
    at.iter()
        .fold(String::from(name), |name, index| format!("{name}[{index}]"))
}
