//! Checked sizes and shapes in the engine's terms.
//!
//! Input: types of check. Output: shapes of the model. Invariant: sizes have the same numbers in both.

use crate::checked::{Extent, Type};
use hamiltonian_symbolic::model::Shape;

/// A shape.
pub fn shape(ty: Type) -> Shape {
    match ty {
        Type::Bool | Type::Scalar => Shape::Scalar,
        Type::Vector(rows) => Shape::Vector(rows.affine()),
        Type::Matrix(rows, columns) => Shape::Matrix(rows.affine(), columns.affine()),
    }
}

/// The shape of a group of coordinates. Its columns are literal; `None` where they are not, which
/// check refuses.
pub fn group_shape(ty: Type) -> Option<Shape<u16>> {
    Some(match ty {
        Type::Bool | Type::Scalar => Shape::Scalar,
        Type::Vector(rows) => Shape::Vector(rows.affine()),
        Type::Matrix(rows, Extent::Literal(columns)) => {
            Shape::Matrix(rows.affine(), u16::try_from(columns).ok()?)
        }
        Type::Matrix(_, Extent::Size(_)) => return None,
    })
}
