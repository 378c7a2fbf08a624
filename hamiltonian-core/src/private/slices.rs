//! Columns of arrays, as slices that emitted code reads and writes.
//!
//! Input: a column-major array, or a vector that is one. Output: its columns. Invariant: they have the number of
//! elements that the system says, so an element in range needs no check.

use crate::systems::vector::Vector;

/// The `C` columns, of `rows` elements each, of a column-major array.
///
/// # Panics
///
/// On an array of another size: a state that does not fit the system.
#[inline(always)]
#[must_use]
pub fn columns<T, const C: usize>(mut rest: &[T], rows: usize) -> [&[T]; C] {
    assert_shape(rest.len(), rows, C);
    let mut columns = [rest; C];
    for column in &mut columns {
        (*column, rest) = rest.split_at(rows);
    }
    columns
}

/// The columns of a vector of one array.
///
/// # Panics
///
/// On an array of another size: a state that does not fit the system.
#[inline(always)]
#[must_use]
pub fn columns_of<V: Vector, const C: usize>(of: &V, rows: usize) -> [&[V::Scalar]; C] {
    columns(of.part(0), rows)
}

/// The same to write to.
///
/// # Panics
///
/// On an array of another size: a state that does not fit the system.
#[inline(always)]
#[must_use]
pub fn columns_of_mut<V: Vector, const C: usize>(of: &mut V, rows: usize) -> [&mut [V::Scalar]; C] {
    columns_mut(of.part_mut(0), rows)
}

/// The columns of an array that is written to.
///
/// # Panics
///
/// On an array of another size: a state that does not fit the system.
#[inline(always)]
#[must_use]
pub fn columns_mut<T, const C: usize>(mut rest: &mut [T], rows: usize) -> [&mut [T]; C] {
    assert_shape(rest.len(), rows, C);
    core::array::from_fn(|_| {
        let (column, after) = core::mem::take(&mut rest).split_at_mut(rows);
        rest = after;
        column
    })
}

#[inline(always)]
fn assert_shape(given: usize, rows: usize, columns: usize) {
    assert!(
        given == rows * columns,
        "the state has {given} elements where the system has {rows}×{columns}: `check_shape` checks \
         states of any length"
    );
}
