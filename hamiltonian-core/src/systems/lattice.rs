//! Arrays with several axes.
//!
//! Input: extents and elements. Output: [`Lattice`]. Invariant: elements are stored in the order of the
//! declaration, the last index fastest, so that a loop over the last axis moves on by one.

mod nested;

pub use nested::lattice;

use crate::errors::InputError;
use crate::systems::uneven::{Uneven, same_part};
use crate::systems::vector::{Shape, Vector};
use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt::{self, Write};
use core::ops::{Index, IndexMut};
use hamiltonian_lanes::{Mask, Real};

/// An array with `R` axes: the coordinates `u[n][m]` are a `Lattice<f64, 2>`, and the parameter `w[n][m][k]` is a
/// `Lattice<f64, 3>`.
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
    /// Two rows of different lengths in the nested lists of its construction. Then there are no
    /// elements.
    uneven: Option<Box<Uneven>>,
}

impl<T: Real, const R: usize> Lattice<T, R> {
    /// The array whose element at each place is `f(place)`.
    ///
    /// # Panics
    /// If so many elements do not fit into memory.
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
    ///
    /// # Panics
    /// If so many elements do not fit into memory.
    #[must_use]
    pub fn zeros(extents: [usize; R]) -> Self {
        let Some(number) = product(&extents) else {
            panic!("a lattice of the extents {extents:?} does not fit into memory");
        };
        Lattice {
            extents,
            elements: alloc::vec![T::zero(); number],
            uneven: None,
        }
    }
}

#[cfg(feature = "serde")]
impl<T> Lattice<T, 2> {
    /// Rows of one element each.
    pub(crate) fn column(elements: Vec<T>) -> Self {
        Lattice {
            extents: [elements.len(), 1],
            elements,
            uneven: None,
        }
    }
}

impl<T, const R: usize> Lattice<T, R> {
    /// The extent of each axis.
    #[must_use]
    pub fn extents(&self) -> [usize; R] {
        self.extents
    }

    /// Returns the array of `f` of each element.
    #[must_use]
    pub fn map<U>(&self, f: impl FnMut(T) -> U) -> Lattice<U, R>
    where
        T: Copy,
    {
        Lattice {
            extents: self.extents,
            elements: self.elements.iter().copied().map(f).collect(),
            uneven: self.uneven.clone(),
        }
    }

    /// The elements in the order of the declaration, the last index fastest.
    #[cfg_attr(not(unoptimised), inline(always))]
    #[must_use]
    pub fn as_slice(&self) -> &[T] {
        &self.elements
    }

    /// The elements, mutable, in the same order.
    #[cfg_attr(not(unoptimised), inline(always))]
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

impl<const R: usize> Shape for Lattice<(), R> {
    type Vector<T: Real> = Lattice<T, R>;
}

impl<T: Real, const R: usize> Vector for Lattice<T, R> {
    type Scalar = T;
    type Shape = Lattice<(), R>;
    fn zeros_over<U: Real>(&self) -> Lattice<U, R> {
        Lattice {
            extents: self.extents,
            elements: alloc::vec![U::zero(); self.elements.len()],
            uneven: self.uneven.clone(),
        }
    }
    const PARTS: usize = 1;
    fn extents(&self, _: usize) -> &[usize] {
        &self.extents
    }
    fn uneven(&self, _: usize) -> Option<&Uneven> {
        self.uneven.as_deref()
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn part(&self, _: usize) -> &[T] {
        &self.elements
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn part_mut(&mut self, _: usize) -> &mut [T] {
        &mut self.elements
    }
    fn zeros_like(&self) -> Self {
        self.zeros_over()
    }
    #[cfg_attr(not(unoptimised), inline(always))]
    fn take(&mut self) -> Self {
        let none = Lattice {
            extents: [0; R],
            elements: Vec::new(),
            uneven: None,
        };
        core::mem::replace(self, none)
    }
}

/// The number of elements of these extents, if it is a `usize`.
fn product(extents: &[usize]) -> Option<usize> {
    match extents.contains(&0) {
        true => Some(0),
        false => extents.iter().try_fold(1usize, |n, m| n.checked_mul(*m)),
    }
}

/// Checks that coordinates of these extents fit into memory.
///
/// # Errors
/// [`InputError::Memory`] with the name of the coordinate.
pub fn fits(name: &str, extents: &[usize]) -> Result<(), InputError> {
    let has_room = |number: usize| Vec::<f64>::new().try_reserve_exact(number).is_ok();
    match product(extents) {
        Some(number) if has_room(number) => Ok(()),
        _ => Err(InputError::Memory { name: name.into() }),
    }
}

/// The name of an element, given its number in the order of the declaration: `u[1][2]`.
pub(crate) fn element(name: &str, extents: &[usize], number: usize) -> String {
    let mut text = String::from(name);
    // Writing to a string does not fail.
    let _ = write_indices(&mut text, extents, number);
    text
}

/// Writes the indices of an element, given its number in the order of the declaration: `[1][2]`.
pub(crate) fn write_indices(out: &mut dyn Write, extents: &[usize], number: usize) -> fmt::Result {
    let mut rest: usize = extents.iter().product();
    extents.iter().try_for_each(|extent| {
        rest /= extent;
        write!(out, "[{}]", number / rest % extent)
    })
}

/// An error where an element of a parameter is NaN. The last index of `values` is the fastest.
///
/// # Errors
/// [`InputError::Parameter`] with the name of the first.
pub fn check_parameter<T: Real>(
    name: &str,
    extents: &[usize],
    values: &[T],
) -> Result<(), InputError> {
    match values.iter().position(|value| !value.equals(*value).all()) {
        None => Ok(()),
        Some(at) => Err(InputError::Parameter {
            name: element(name, extents, at).into(),
        }),
    }
}

/// Checks the extents and the numbers of a parameter with several axes.
///
/// # Errors
/// [`InputError::Row`] if nested lists differ in length, [`InputError::Extent`] if an extent is not the declared one,
/// [`InputError::Memory`] if no array has so many elements, [`InputError::Parameter`] for the first number that is NaN.
pub fn check_lattice<T: Real, const R: usize>(
    name: &str,
    extents: [usize; R],
    given: &Lattice<T, R>,
) -> Result<(), InputError> {
    check_axes(name, extents, given)?;
    check_parameter(name, &extents, &given.elements)
}

/// Checks the extents of a parameter with several axes.
pub(crate) fn check_axes<T: Real, const R: usize>(
    name: &str,
    extents: [usize; R],
    given: &Lattice<T, R>,
) -> Result<(), InputError> {
    let Some(number) = product(&extents) else {
        return Err(InputError::Memory { name: name.into() });
    };
    let found = (&given.extents[..], given.elements.len());
    same_part(name, given.uneven(0), (&extents, number), found)
}

/// Checks the rows and columns of an array of parameters.
///
/// # Errors
/// [`InputError::Shape`] if the number of elements differs, [`InputError::Extent`] if an extent does,
/// [`InputError::Memory`] if no array has so many elements.
pub fn check_extents(
    name: &str,
    expected: [usize; 2],
    found: [usize; 2],
) -> Result<(), InputError> {
    let Some(number) = product(&expected) else {
        return Err(InputError::Memory { name: name.into() });
    };
    // An array that exists has a number of elements.
    let given = found[0] * found[1];
    if number != given {
        return Err(InputError::Shape {
            name: name.into(),
            expected: number,
            found: given,
        });
    }
    match (0..2).find(|axis| expected[*axis] != found[*axis]) {
        Some(axis) if number > 0 => Err(InputError::Extent {
            name: name.into(),
            axis,
            expected: expected[axis],
            found: found[axis],
        }),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_beyond_memory_are_told() {
        assert!(fits("u", &[1000, 1000]).is_ok());
        for extents in [[usize::MAX, 2], [1 << 31, 1 << 31]] {
            let error = fits("u", &extents);
            assert!(
                matches!(&error, Err(InputError::Memory { name }) if **name == *"u"),
                "{error:?}"
            );
        }
    }
}
