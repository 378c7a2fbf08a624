//! Checked sizes and shapes in the engine's terms.
//!
//! Input: types of check. Output: shapes of the model. Invariant: sizes have the same numbers in both.

use crate::checked::{Extent, Group, Type};
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::model::Shape;

/// A shape.
pub fn shape(ty: Type) -> Shape {
    match ty {
        Type::Bool | Type::Scalar => Shape::Scalar,
        Type::Vector(rows) => Shape::Vector(rows.affine()),
        Type::Matrix(rows, columns) => Shape::Matrix(rows.affine(), columns.affine()),
        Type::Array(_) => lattice(ty).unwrap_or(Shape::Scalar),
    }
}

/// The shape of an array that is stored row after row; `None` if the number of elements overflows.
fn lattice<C>(ty: Type) -> Option<Shape<C>> {
    let extents = ty.extents().into_iter().map(Extent::affine);
    Some(Shape::Lattice(ty.elements()?, extents.into_list()))
}

/// The shape of a group of coordinates: the columns of a matrix that is no lattice are literal. `None` if they are
/// not; `check` refuses that.
pub fn group_shape(group: &Group) -> Option<Shape<u16>> {
    if group.is_lattice {
        return lattice(group.ty);
    }
    Some(match group.ty {
        Type::Bool | Type::Scalar => Shape::Scalar,
        Type::Vector(rows) => Shape::Vector(rows.affine()),
        Type::Matrix(rows, Extent::Literal(columns)) => {
            Shape::Matrix(rows.affine(), u16::try_from(columns).ok()?)
        }
        Type::Matrix(..) | Type::Array(_) => return None,
    })
}
