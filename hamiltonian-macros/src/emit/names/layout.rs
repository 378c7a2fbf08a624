//! The layout of coordinates, and the slices that function bodies read and write.
//!
//! Input: the groups of a model, arrays and targets of a program. Output: [`Layout`] and [`Slice`].
//! Invariant: element (row, column) of a column-major array is `row` of the slice of its column;
//! scalar coordinates share one vector, in the order of their groups.

use hamiltonian_symbolic::dag::{Array, Column, Parameter, Side};
use hamiltonian_symbolic::model::{Group, Shape};
use hamiltonian_symbolic::program::Target;

/// The storage of the coordinates of a system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// Scalars only: one static vector.
    Scalars,
    /// One group with extents: one vector or matrix.
    Array,
    /// Anything else: a generated struct with one part a group.
    Mixed,
}

/// The column of the vector that is stored: scalar coordinates share one.
fn stored(layout: Layout, column: Column) -> Column {
    match layout {
        Layout::Scalars => Column { group: 0, ..column },
        Layout::Array | Layout::Mixed => column,
    }
}

/// The storage of a group.
pub fn layout(groups: &[Group]) -> Layout {
    if groups.iter().all(|group| group.shape == Shape::Scalar) {
        Layout::Scalars
    } else if groups.len() == 1 {
        Layout::Array
    } else {
        Layout::Mixed
    }
}

/// A slice that a function body reads or writes: a column of a vector, an array of numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Slice {
    /// Elements are read from it.
    Read(Array),
    /// Elements are written to it.
    Write(Target),
}

impl Slice {
    /// The slice an array's elements are read from.
    pub fn read(layout: Layout, array: Array) -> Slice {
        Slice::Read(match array {
            Array::Phase(column) => Array::Phase(stored(layout, column)),
            Array::Direction(column) => Array::Direction(stored(layout, column)),
            array => array,
        })
    }

    /// The slice a target's elements are written to.
    pub fn write(layout: Layout, target: Target) -> Slice {
        Slice::Write(match target {
            Target::Phase(column) => Target::Phase(stored(layout, column)),
            target => target,
        })
    }

    /// Its name in a function body.
    pub fn name(self) -> String {
        if let Some((vector, Column { group, column, .. })) = self.part() {
            return format!("{vector}{group}_{column}");
        }
        match self {
            Slice::Read(Array::Parameter(Parameter(number))) => format!("_a{number}"),
            Slice::Write(Target::Parameter(Parameter(number))) => format!("_d{number}"),
            Slice::Read(Array::Hoisted(number)) => format!("_h{number}"),
            Slice::Write(Target::Hoisted(number)) => format!("_u{number}"),
            _ => unreachable!("`validate` finds velocities in a program"),
        }
    }

    /// The element of a scalar coordinate, or of its momentum, without a slice.
    pub fn scalar(self, group: u16) -> String {
        let (vector, _) = self.part().expect("it is a coordinate");
        format!("{vector}.data.0[0][{group}]")
    }

    /// The vector it is a part of, by its name, and its column; `None` for other arrays.
    pub fn part(self) -> Option<(&'static str, Column)> {
        let ([q, p], at) = match self {
            Slice::Read(Array::Phase(at)) => (["_q", "_p"], at),
            Slice::Read(Array::Direction(at)) => (["_vq", "_vp"], at),
            Slice::Write(Target::Phase(at)) => (["_oq", "_op"], at),
            _ => return None,
        };
        Some((if at.side == Side::Q { q } else { p }, at))
    }

    /// Returns true if elements are written to it.
    pub fn is_written(self) -> bool {
        matches!(self, Slice::Write(_))
    }
}
