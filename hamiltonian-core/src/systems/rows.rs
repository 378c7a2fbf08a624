//! Rows of arrays with two extents, without nalgebra.
//!
//! Input: the storage of `q[n][3]` or `u[n][m]`. Output: its rows as arrays or slices. Invariant: rows are in the order
//! of the declaration, whatever the order of storage.

use crate::systems::lattice::Lattice;
use alloc::vec::Vec;
use hamiltonian_lanes::Real;
use nalgebra::{Const, Dyn, OMatrix, SMatrix};

/// Arrays with two extents, row by row: the positions of bodies, the rows of a lattice, or those of a parameter.
///
/// A row of `q[n][3]` is an array `[f64; 3]`. A row of a [`Lattice`] is a slice. The prelude imports the methods.
///
/// ```
/// use hamiltonian::prelude::*;
///
/// let bodies = State::new(vec![[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]], vec![[0.0; 3]; 2]);
/// assert_eq!(bodies.q.row_at(1), [4.0, 5.0, 6.0]);
/// for [x, y, z] in bodies.q.each_row() {
///     println!("{x} {y} {z}");
/// }
/// let positions: Vec<[f64; 3]> = bodies.q.each_row().collect();
/// assert_eq!(State::new(positions, vec![[0.0; 3]; 2]), bodies);
///
/// let field = State::new(vec![vec![0.5; 8]; 3], vec![vec![0.0; 8]; 3]);
/// assert_eq!(field.q.row_at(2), [0.5; 8]);
/// ```
pub trait ByRow {
    /// A row.
    type Row<'a>
    where
        Self: 'a;

    /// The rows in order.
    fn each_row(&self) -> impl ExactSizeIterator<Item = Self::Row<'_>>;

    /// Row `i`, from 0.
    ///
    /// # Panics
    /// If there is no such row.
    fn row_at(&self, i: usize) -> Self::Row<'_> {
        let rows = self.each_row().len();
        match self.each_row().nth(i) {
            Some(row) => row,
            None => panic!("row {i} of an array with {rows} rows"),
        }
    }
}

macro_rules! by_row {
    ($([$($generics:tt)*] $storage:ty, $row:ty, |$matrix:ident, $i:ident| $at:expr;)*) => { $(
        impl<T: Real, $($generics)*> ByRow for $storage {
            type Row<'a> = $row;
            fn each_row(&self) -> impl ExactSizeIterator<Item = $row> {
                let $matrix = self;
                (0..self.nrows()).map(move |$i| $at)
            }
        }
    )* };
}

by_row! {
    [const R: usize, const C: usize] SMatrix<T, R, C>, [T; C], |m, i| core::array::from_fn(|c| m[(i, c)]);
    [const C: usize] OMatrix<T, Dyn, Const<C>>, [T; C], |m, i| core::array::from_fn(|c| m[(i, c)]);
    [const R: usize] OMatrix<T, Const<R>, Dyn>, Vec<T>, |m, i| (0..m.ncols()).map(|c| m[(i, c)]).collect();
    [] OMatrix<T, Dyn, Dyn>, Vec<T>, |m, i| (0..m.ncols()).map(|c| m[(i, c)]).collect();
}

impl<T: Real> ByRow for Lattice<T, 2> {
    type Row<'a> = &'a [T];
    fn each_row(&self) -> impl ExactSizeIterator<Item = &[T]> {
        let [rows, columns] = self.extents();
        (0..rows).map(move |i| &self.as_slice()[i * columns..(i + 1) * columns])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::systems::vector::IntoVector;
    use alloc::vec;

    #[test]
    fn rows_are_those_given() {
        let rows = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]];
        let fixed = rows.into_vector();
        // Storage is column after column.
        assert_eq!(fixed.as_slice(), [1.0, 4.0, 2.0, 5.0, 3.0, 6.0]);
        assert!(fixed.each_row().eq(rows));
        assert!(rows.to_vec().into_vector().each_row().eq(rows));
        let lists = rows.map(Vec::from).to_vec();
        assert!(lists.clone().into_vector().each_row().eq(&lists));
        let wide = OMatrix::<f64, Dyn, Dyn>::from_fn(2, 3, |i, c| rows[i][c]);
        assert!(wide.each_row().eq(lists));
        assert_eq!(wide.row_at(1), vec![4.0, 5.0, 6.0]);
    }

    #[test]
    fn arrays_without_rows_have_none() {
        let none = Vec::<[f64; 3]>::new().into_vector();
        assert_eq!(none.each_row().len(), 0);
        assert_eq!(Lattice::<f64, 2>::zeros([2, 0]).row_at(1), [0.0; 0]);
    }

    #[test]
    #[should_panic(expected = "row 2 of an array with 2 rows")]
    fn a_row_that_is_not_there_is_named() {
        let _ = [[1.0; 3]; 2].into_vector().row_at(2);
    }
}
