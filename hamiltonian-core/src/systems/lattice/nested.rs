//! Lattices from nested lists.
//!
//! Input: `Vec`s and arrays of `Vec`s and arrays, of equal lengths or not. Output: [`Lattice`]. Invariant: lists of
//! unequal lengths become a lattice without elements that names two of
//! them, since a [`State`](crate::State) is made without an error.

use super::Lattice;
use crate::systems::uneven::Uneven;
use crate::systems::vector::{IntoVector, shape};
use alloc::boxed::Box;
use alloc::vec::Vec;
use hamiltonian_lanes::Real;

/// A list of `R` levels.
pub trait NestedList<const R: usize> {
    /// The type of its numbers.
    type Scalar: Real;
    /// The extents of the parts of the first level, and the elements.
    ///
    /// # Errors
    /// Two parts of different lengths.
    fn flat(self, elements: &mut Vec<Self::Scalar>) -> Result<[usize; R], Uneven>;
}

impl<T: Real> NestedList<1> for Vec<T> {
    type Scalar = T;
    fn flat(mut self, elements: &mut Vec<T>) -> Result<[usize; 1], Uneven> {
        let length = self.len();
        elements.append(&mut self);
        Ok([length])
    }
}

impl<T: Real, const N: usize> NestedList<1> for [T; N] {
    type Scalar = T;
    fn flat(self, elements: &mut Vec<T>) -> Result<[usize; 1], Uneven> {
        elements.extend(self);
        Ok([N])
    }
}

/// Concatenates lists of one level less.
fn stacked<B: NestedList<R>, const R: usize, const S: usize>(
    parts: impl ExactSizeIterator<Item = B>,
    elements: &mut Vec<B::Scalar>,
) -> Result<[usize; S], Uneven> {
    let mut extents = [0; S];
    extents[0] = parts.len();
    for (i, part) in parts.enumerate() {
        let own = part.flat(elements).map_err(|Uneven(mut two)| {
            two.iter_mut().for_each(|(at, _)| at.insert(0, i));
            Uneven(two)
        })?;
        let before = &mut extents[1..];
        if i == 0 {
            before.copy_from_slice(&own);
        }
        if let Some(axis) = (0..R).find(|axis| own[*axis] != before[*axis]) {
            // The first list of the part before, and of this one.
            let at = |i| {
                let mut at = alloc::vec![0; axis + 1];
                at[0] = i;
                at
            };
            return Err(Uneven([(at(i - 1), before[axis]), (at(i), own[axis])]));
        }
    }
    Ok(extents)
}

macro_rules! levels {
    ($($inner:literal $outer:literal),*) => { $(
        impl<B: NestedList<$inner>> NestedList<$outer> for Vec<B> {
            type Scalar = B::Scalar;
            fn flat(self, elements: &mut Vec<B::Scalar>) -> Result<[usize; $outer], Uneven> {
                stacked::<B, $inner, $outer>(self.into_iter(), elements)
            }
        }
        impl<B: NestedList<$inner>, const N: usize> NestedList<$outer> for [B; N] {
            type Scalar = B::Scalar;
            fn flat(self, elements: &mut Vec<B::Scalar>) -> Result<[usize; $outer], Uneven> {
                stacked::<B, $inner, $outer>(self.into_iter(), elements)
            }
        }
    )* };
}

levels!(1 2, 2 3, 3 4);

/// The lattice of a nested list.
pub fn lattice<N: NestedList<R>, const R: usize>(list: N) -> Lattice<N::Scalar, R> {
    let mut elements = Vec::new();
    let (extents, uneven) = match list.flat(&mut elements) {
        Ok(extents) => (extents, None),
        Err(uneven) => {
            elements.clear();
            ([0; R], Some(Box::new(uneven)))
        }
    };
    Lattice {
        extents,
        elements,
        uneven,
    }
}

/// [`IntoVector`] for lists of `Vec`s.
macro_rules! rows {
    ($([$($generics:tt)*] $list:ty $(, $copied:ident)?;)*) => { $(
        impl<T: Real, $($generics)*> IntoVector<shape::Nested<2>> for $list {
            type Vector = Lattice<T, 2>;
            fn into_vector(self) -> Lattice<T, 2> {
                lattice(self$(.$copied())?)
            }
        }
    )* };
}

rows! {
    [] Vec<Vec<T>>;
    [] &Vec<Vec<T>>, clone;
    [] &[Vec<T>], to_vec;
    [const N: usize] [Vec<T>; N];
    [const N: usize] &[Vec<T>; N], clone;
}

macro_rules! vectors {
    ($($inner:literal $outer:literal),*) => { $(
        impl<B: NestedList<$inner>> IntoVector<shape::Nested<$outer>> for Vec<B> {
            type Vector = Lattice<B::Scalar, $outer>;
            fn into_vector(self) -> Self::Vector {
                lattice(self)
            }
        }
        impl<B: NestedList<$inner>, const N: usize> IntoVector<shape::Nested<$outer>> for [B; N] {
            type Vector = Lattice<B::Scalar, $outer>;
            fn into_vector(self) -> Self::Vector {
                lattice(self)
            }
        }
    )* };
}

vectors!(2 3, 3 4);

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
        let due = Lattice::from_fn([3, 2, 1], |[_, j, _]| 1.0 + j as f64);
        assert_eq!(vec![vec![vec![1.0], vec![2.0]]; 3].into_vector(), due);
        assert_eq!(vec![vec![[1.0], [2.0]]; 3].into_vector(), due);
        assert_eq!(vec![[[1.0], [2.0]]; 3].into_vector(), due);
        assert_eq!([[[1.0], [2.0]]; 3].into_vector(), due);
        let four = [[[[1.0, 2.0]; 2]; 3]; 2].into_vector();
        assert_eq!(four.extents(), [2, 3, 2, 2]);
        assert_eq!(four[[1, 2, 0, 1]], 2.0);
    }

    #[test]
    fn uneven_lists_have_no_elements_and_name_the_one_that_does_not_fit() {
        let error = |lattice: &Lattice<f64, 2>, extents: [usize; 2]| {
            assert!(lattice.as_slice().is_empty());
            lattice
                .uneven
                .as_ref()
                .unwrap()
                .error("u", &extents)
                .to_string()
        };
        let rows = |lengths: [usize; 3]| lengths.map(|n| vec![1.0; n]).to_vec().into_vector();
        let second = "`u[1]` must have 3 elements, found 2";
        assert_eq!(error(&rows([3, 2, 3]), [3, 3]), second);
        let first = "`u[0]` must have 3 elements, found 2";
        assert_eq!(error(&rows([2, 3, 3]), [3, 3]), first);
        let last = "`u[2]` must have 2 elements, found 3";
        assert_eq!(error(&rows([2, 2, 3]), [3, 2]), last);
    }

    #[test]
    fn uneven_lists_inside_lists_have_both_indices() {
        let error = |list: Vec<Vec<Vec<f64>>>| {
            let lattice = list.into_vector();
            lattice.uneven.unwrap().error("u", &[2, 2, 3]).to_string()
        };
        let (row, short) = (vec![1.0; 3], vec![1.0; 2]);
        let whole = vec![row.clone(), row.clone()];
        assert_eq!(
            error(vec![whole.clone(), vec![row.clone(), short.clone()]]),
            "`u[1][1]` must have 3 elements, found 2"
        );
        assert_eq!(
            error(vec![whole.clone(), vec![row]]),
            "`u[1]` must have 2 elements, found 1"
        );
        assert_eq!(
            error(vec![whole, vec![short.clone(), short]]),
            "`u[1][0]` must have 3 elements, found 2"
        );
    }
}
