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

/// A slice that a function body reads or writes: a column of a group, a parameter array.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Slice {
    /// Coordinates or momenta.
    Input(Column),
    /// The direction of a Hessian product.
    Direction(Column),
    /// A parameter array.
    Parameter(u16),
    /// An output vector.
    Output(Column),
    /// The derivative with respect to a parameter.
    Derivative(u16),
    /// An array that preparation filled.
    Held(u16),
    /// The same while it is filled.
    Filled(u16),
}

impl Slice {
    /// The slice an array's elements are read from.
    pub fn read(layout: Layout, array: Array) -> Slice {
        match array {
            Array::Phase(column) => Slice::Input(stored(layout, column)),
            Array::Direction(column) => Slice::Direction(stored(layout, column)),
            Array::Velocity(_) => unreachable!("`validate` finds velocities in a program"),
            Array::Parameter(Parameter(number)) => Slice::Parameter(number),
            Array::Held(number) => Slice::Held(number),
        }
    }

    /// The slice a target's elements are written to.
    pub fn write(layout: Layout, target: Target) -> Slice {
        match target {
            Target::Phase(column) => Slice::Output(stored(layout, column)),
            Target::Parameter(Parameter(number)) => Slice::Derivative(number),
            Target::Held(number) => Slice::Filled(number),
        }
    }

    /// Its name in a function body.
    pub fn name(self) -> String {
        let number = match self {
            Slice::Input(at) | Slice::Direction(at) | Slice::Output(at) => {
                format!("{}_{}", at.group, at.column)
            }
            Slice::Parameter(number) => return format!("_a{number}"),
            Slice::Derivative(number) => return format!("_d{number}"),
            Slice::Held(number) => return format!("_h{number}"),
            Slice::Filled(number) => return format!("_u{number}"),
        };
        format!("{}{number}", self.vector())
    }

    /// The name of the vector it is a part of.
    pub fn vector(self) -> &'static str {
        match self {
            Slice::Input(at) if at.side == Side::Q => "_q",
            Slice::Input(_) => "_p",
            Slice::Direction(at) if at.side == Side::Q => "_vq",
            Slice::Direction(_) => "_vp",
            Slice::Output(at) if at.side == Side::Q => "_oq",
            Slice::Output(_) => "_op",
            _ => "",
        }
    }

    /// Whether it is written, and its column; `None` for parameters.
    pub fn part(self) -> Option<(bool, Column)> {
        match self {
            Slice::Input(column) | Slice::Direction(column) => Some((false, column)),
            Slice::Output(column) => Some((true, column)),
            _ => None,
        }
    }
}
