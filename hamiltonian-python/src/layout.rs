//! Coordinates as Python orders them: each array row after row.
//!
//! Input: the groups of a description. Output: their shapes, and copies from and to the order of the system. Invariant: a
//! group keeps its place, and only arrays of two axes change their order.

use hamiltonian_core::schemes::author::Description;

/// The places of the numbers of a state.
pub struct Layout {
    len: usize,
    /// The place in the system of each number; none if all are at their own.
    places: Option<Vec<usize>>,
    /// The extents of each group.
    shapes: Vec<Vec<usize>>,
}

impl Layout {
    pub fn new(description: &Description, len: usize) -> Self {
        let groups = &description.groups;
        let ends = groups.iter().skip(1).map(|group| group.offset).chain([len]);
        let mut shapes = Vec::new();
        let mut places = Vec::new();
        for (group, end) in groups.iter().zip(ends) {
            let columns = group.columns.max(1);
            let rows = (end - group.offset) / columns;
            shapes.push(match group.rank {
                0 => Vec::new(),
                1 => vec![rows],
                _ => vec![rows, columns],
            });
            if rows > 1 && columns > 1 {
                // Those of the groups before, which have one axis.
                places.extend(places.len()..group.offset);
                for row in 0..rows {
                    places.extend((0..columns).map(|column| group.offset + column * rows + row));
                }
            }
        }
        let is_moved = !places.is_empty();
        if is_moved {
            places.extend(places.len()..len);
        }
        Layout {
            len,
            places: is_moved.then_some(places),
            shapes,
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
