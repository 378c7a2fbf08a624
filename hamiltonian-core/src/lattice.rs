//! Coordinates with several axes.
//!
//! Input: extents and elements. Output: [`Lattice`]. Invariant: elements are stored in the order of the
//! declaration, the last index fastest, so that a loop over the last axis moves on by one.

use crate::error::Error;
use crate::vector::{IntoVector, Vector, shape};
use alloc::vec::Vec;
use core::ops::{Index, IndexMut};
use hamiltonian_lanes::Real;

/// An array with `R` axes: the coordinates `u[n][m]` are a `Lattice<f64, 2>`.
///
/// Element `[i, j]` stands at `i·m + j` of [`as_slice`](Lattice::as_slice).
///
/// ```
/// use hamiltonian::Lattice;
/// let u = Lattice::from_fn([2, 3], |[i, j]| (10 * i + j) as f64);
/// assert_eq!(u[[1, 2]], 12.0);
/// assert_eq!(u.as_slice(), [0.0, 1.0, 2.0, 10.0, 11.0, 12.0]);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Lattice<T, const R: usize> {
    extents: [usize; R],
    elements: Vec<T>,
}

impl<T: Real, const R: usize> Lattice<T, R> {
    /// The array whose element at each place is `f(place)`.
    #[must_use]
    pub fn from_fn(extents: [usize; R], mut f: impl FnMut([usize; R]) -> T) -> Self {
        let mut made = Self::zeros(extents);
        let mut place = [0; R];
        for element in &mut made.elements {
            *element = f(place);
            for axis in (0..R).rev() {
                place[axis] += 1;
                if place[axis] < extents[axis] {
                    break;
                }
                place[axis] = 0;
            }
        }
        made
    }

    /// The array of zeros.
    #[must_use]
    pub fn zeros(extents: [usize; R]) -> Self {
        Lattice {
            extents,
            elements: alloc::vec![T::zero(); extents.iter().product()],
        }
    }
}

impl<T, const R: usize> Lattice<T, R> {
    /// The extent of each axis.
    #[must_use]
    pub fn extents(&self) -> [usize; R] {
        self.extents
    }

    /// The elements in the order of the declaration, the last index fastest.
    #[inline(always)]
    #[must_use]
    pub fn as_slice(&self) -> &[T] {
        &self.elements
    }

    /// The same, to be changed.
    #[inline(always)]
    pub fn as_mut_slice(&mut self) -> &mut [T] {
        &mut self.elements
    }

    /// The number of an element.
    fn number(&self, place: [usize; R]) -> usize {
        let mut number = 0;
        for (axis, (at, extent)) in place.into_iter().zip(self.extents).enumerate() {
            assert!(
                at < extent,
                "index {at} of axis {axis} is outside 0..{extent}"
            );
            number = number * extent + at;
        }
        number
    }
}

/// # Panics
/// If an index is outside its axis.
impl<T, const R: usize> Index<[usize; R]> for Lattice<T, R> {
    type Output = T;
    fn index(&self, place: [usize; R]) -> &T {
        &self.elements[self.number(place)]
    }
}

/// # Panics
/// If an index is outside its axis.
impl<T, const R: usize> IndexMut<[usize; R]> for Lattice<T, R> {
    fn index_mut(&mut self, place: [usize; R]) -> &mut T {
        let number = self.number(place);
        &mut self.elements[number]
    }
}

impl<T: Real, const R: usize> Vector for Lattice<T, R> {
    type Scalar = T;
    type Over<U: Real> = Lattice<U, R>;
    fn zeros_over<U: Real>(&self) -> Lattice<U, R> {
        Lattice {
            extents: self.extents,
            elements: alloc::vec![U::zero(); self.elements.len()],
        }
    }
    const PARTS: usize = 1;
    fn extents(&self, _: usize) -> &[usize] {
        &self.extents
    }
    #[inline(always)]
    fn part(&self, _: usize) -> &[T] {
        &self.elements
    }
    #[inline(always)]
    fn part_mut(&mut self, _: usize) -> &mut [T] {
        &mut self.elements
    }
    fn zeros_like(&self) -> Self {
        self.zeros_over()
    }
    #[inline(always)]
    fn take(&mut self) -> Self {
        let none = Lattice {
            extents: [0; R],
            elements: Vec::new(),
        };
        core::mem::replace(self, none)
    }
}

/// Lattices of one rank less, one after the other. Where their extents differ there are no elements, which
/// no system of some size takes, and the extents are those of the first that differs from the one before.
fn stacked<T, const R: usize, const S: usize>(
    rows: impl ExactSizeIterator<Item = ([usize; R], Vec<T>)>,
) -> Lattice<T, S> {
    let mut extents = [0; S];
    extents[0] = rows.len();
    let mut elements = Vec::new();
    let mut inner = None;
    for (own, row) in rows {
        let is_new = inner.replace(own).is_some_and(|before| before != own);
        if is_new {
            elements.clear();
            break;
        }
        elements.extend(row);
    }
    extents[1..].copy_from_slice(&inner.unwrap_or([0; R]));
    Lattice { extents, elements }
}

impl<T: Real> IntoVector<shape::Nested> for Vec<Vec<T>> {
    type Vector = Lattice<T, 2>;
    fn into_vector(self) -> Lattice<T, 2> {
        stacked(self.into_iter().map(|row| ([row.len()], row)))
    }
}

impl<T: Real> IntoVector<shape::TwiceNested> for Vec<Vec<Vec<T>>> {
    type Vector = Lattice<T, 3>;
    fn into_vector(self) -> Lattice<T, 3> {
        stacked(self.into_iter().map(|plane| {
            let plane = plane.into_vector();
            (plane.extents, plane.elements)
        }))
    }
}

/// Whether coordinates of these extents fit into memory.
///
/// # Errors
/// [`Error::Memory`] with the name of the coordinate.
pub fn fits(name: &'static str, extents: &[usize]) -> Result<(), Error> {
    let number = extents.iter().try_fold(1usize, |n, m| n.checked_mul(*m));
    let has_room = |number: usize| Vec::<f64>::new().try_reserve_exact(number).is_ok();
    match number {
        Some(number) if has_room(number) => Ok(()),
        _ => Err(Error::Memory { name }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;

    #[test]
    fn nested_lists_are_lattices() {
        let plane = vec![vec![1.0, 2.0, 3.0], vec![4.0, 5.0, 6.0]].into_vector();
        assert_eq!(plane.extents(), [2, 3]);
        assert_eq!(plane.as_slice(), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        assert_eq!(plane[[1, 0]], 4.0);
        let space = vec![vec![vec![1.0], vec![2.0]]; 3].into_vector();
        assert_eq!(space.extents(), [3, 2, 1]);
        assert_eq!(space.as_slice(), [1.0, 2.0, 1.0, 2.0, 1.0, 2.0]);
    }

    #[test]
    fn rows_of_different_lengths_have_no_elements() {
        let ragged = vec![vec![1.0, 2.0], vec![3.0], vec![4.0, 5.0]].into_vector();
        assert_eq!(ragged.extents(), [3, 1]);
        assert!(ragged.as_slice().is_empty());
    }

    #[test]
    fn sizes_beyond_memory_are_told() {
        assert!(fits("u", &[1000, 1000]).is_ok());
        for extents in [[usize::MAX, 2], [1 << 31, 1 << 31]] {
            let error = fits("u", &extents);
            assert!(
                matches!(error, Err(Error::Memory { name: "u" })),
                "{error:?}"
            );
        }
    }
}
