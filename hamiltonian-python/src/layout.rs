//! Coordinates as Python orders them: each array row after row.
//!
//! Input: coordinates. Output: their shapes, and copies from and to the order of the system. Invariant: a
//! group keeps its place, and only arrays of two axes change their order.

use hamiltonian_runtime::Coordinates;

/// The places of the numbers of a state.
pub struct Layout {
    len: usize,
    /// The place in the system of each number; none if all are at their own.
    places: Option<Vec<usize>>,
    /// The extents of each group.
    shapes: Vec<Vec<usize>>,
}

impl Layout {
    pub fn new(coordinates: &[Coordinates]) -> Self {
        let places: Vec<usize> = coordinates.iter().flat_map(Coordinates::places).collect();
        let is_moved = places.iter().enumerate().any(|(at, place)| at != *place);
        let shapes = coordinates.iter().map(|of| of.extents().to_vec());
        Layout {
            len: places.len(),
            shapes: shapes.collect(),
            places: is_moved.then_some(places),
        }
    }

    /// The number of coordinates.
    pub fn len(&self) -> usize {
        self.len
    }

    /// The extents of each group.
    pub fn shapes(&self) -> &[Vec<usize>] {
        &self.shapes
    }

    /// Copies a point of Python into one of the system.
    pub fn read(&self, from: &[f64], into: &mut [f64]) {
        match &self.places {
            None => into.copy_from_slice(from),
            Some(places) => {
                for (number, place) in from.iter().zip(places) {
                    into[*place] = *number;
                }
            }
        }
    }

    /// Copies a point of the system into one of Python.
    pub fn write(&self, from: &[f64], into: &mut [f64]) {
        match &self.places {
            None => into.copy_from_slice(from),
            Some(places) => {
                for (number, place) in into.iter_mut().zip(places) {
                    *number = from[*place];
                }
            }
        }
    }
}
