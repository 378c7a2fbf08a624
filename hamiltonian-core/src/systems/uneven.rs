//! Arrays of another shape than the expected one, and nested lists whose parts have different lengths.
//!
//! Input: extents, or two of the parts. Output: the error that names an axis or a part.

use crate::errors::InputError;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// Two lists of different lengths at the same depth of nested lists: their places and lengths.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Uneven(pub(crate) [(Vec<usize>, usize); 2]);

impl Uneven {
    /// The error for coordinates of these extents: it names a part whose length differs.
    pub(crate) fn error(&self, name: &str, extents: &[usize]) -> InputError {
        let [first, second] = &self.0;
        let expected = extents.get(first.0.len()).copied().unwrap_or_default();
        let (at, found) = if first.1 == expected { second } else { first };
        InputError::Row {
            name: named(name, at).into(),
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

/// An error where the extents or the number of elements of an array are not the expected ones.
pub(crate) fn same_part(
    name: &str,
    uneven: Option<&Uneven>,
    expected: (&[usize], usize),
    found: (&[usize], usize),
) -> Result<(), InputError> {
    if let Some(uneven) = uneven {
        return Err(uneven.error(name, expected.0));
    }
    let ((axes, expected), (own, found)) = (expected, found);
    // Nested lists show no extents inside an empty one.
    let is_empty = expected == 0 && found == 0;
    let mut extents = axes.iter().zip(own).enumerate();
    match extents.find(|(_, (a, b))| !is_empty && a != b) {
        Some((axis, (expected, found))) => Err(InputError::Extent {
            name: name.into(),
            axis,
            expected: *expected,
            found: *found,
        }),
        None if expected != found => Err(InputError::Shape {
            name: name.into(),
            expected,
            found,
        }),
        None => Ok(()),
    }
}
