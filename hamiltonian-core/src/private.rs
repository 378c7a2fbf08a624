//! The only paths that code emitted by `hamiltonian!` names.
//!
//! Input: nothing. Output: re-exports and [`Never`]. Invariant: what is here may be named by code
//! in a crate that has neither this crate nor its dependencies in scope; nothing is removed or
//! renamed without the macro changing with it.

use core::convert::Infallible;
use core::marker::PhantomData;

pub extern crate alloc;
pub use alloc::sync::Arc;
pub use core;

pub use hamiltonian_lanes::{Lift, Mask, Real};
pub use nalgebra::{
    self, ArrayStorage, Const, DVector, Dyn, Matrix, OMatrix, SMatrix, SVector, VecStorage,
};

pub use crate::error::Error;
pub use crate::flow::{Flow, Piece, Pieces, VectorField};
pub use crate::push::{Both, Coupled, SubStep};
pub use crate::reach::Reach;
pub use crate::state::Point;
pub use crate::state::{Gradient, State};
pub use crate::system::{
    Autonomous, Cyclic, Dynamics, Exact, Group, Nystrom, Observable, ObservableKind,
    QuadraticKinetic, Separable, Split, System, Unforced,
};
pub use crate::vector::{IntoVector, Vector};

/// `N` values from number `start` on, as an array that a pattern takes apart: rustc checks a
/// pattern in a hundredth of the time it takes to check as many indices. Emitted code knows that
/// the values are there.
#[inline(always)]
#[must_use]
pub fn window<T, const N: usize>(values: &[T], start: usize) -> &[T; N] {
    match values.get(start..).and_then(<[T]>::first_chunk) {
        Some(window) => window,
        None => panic!(
            "{N} values from number {start} on are not among {}",
            values.len()
        ),
    }
}

/// Writes the elements of a parameter, `m[2] = 1.5` or `K[0][1] = 1.5`, each on a line.
///
/// # Errors
/// Those of the writer.
pub fn describe_array<
    T: Real,
    R: nalgebra::Dim,
    C: nalgebra::Dim,
    S: nalgebra::RawStorage<T, R, C>,
>(
    out: &mut dyn core::fmt::Write,
    name: &str,
    array: &Matrix<T, R, C, S>,
) -> core::fmt::Result {
    let is_vector = C::try_to_usize() == Some(1);
    for (row, column) in (0..array.nrows()).flat_map(|i| (0..array.ncols()).map(move |j| (i, j))) {
        let value = array[(row, column)];
        match is_vector {
            true => writeln!(out, "{name}[{row}] = {value:?}")?,
            false => writeln!(out, "{name}[{row}][{column}] = {value:?}")?,
        }
    }
    Ok(())
}

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

/// The same to write to.
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
        "the state has {given} elements where the system has {rows}×{columns}: states of any length \
         can be asked about with `check_shape`"
    );
}

/// A piece, a flow or pieces that cannot exist: what a structure's associated types are on a system
/// that does not have the structure.
#[derive(Debug)]
pub struct Never<X>(PhantomData<fn() -> X>, Infallible);

impl<X> Clone for Never<X> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<X> Copy for Never<X> {}

impl<X: Vector> Flow<X> for Never<X> {
    const NAME: &'static str = "";
    type Work = ();
    fn apply(&self, _: X::Scalar, _: &mut X, _: &mut ()) {
        match self.1 {}
    }
}

impl<T: Real, P, X: Vector<Scalar = T>> Piece<T, P> for Never<X> {
    type Point = X;
    type Flow = Self;
    fn flow(&self, _: &P, _: T) -> Self {
        *self
    }
}

impl<T: Real, P, X: Vector<Scalar = T>> Pieces<T, P> for Never<X> {
    type Point = X;
    type Outer = Self;
    type Inner = Self;
    fn outer(&self, _: &P, _: T) -> Self {
        *self
    }
    fn inner(&self, _: &P, _: T, _: T) -> Self {
        *self
    }
}
