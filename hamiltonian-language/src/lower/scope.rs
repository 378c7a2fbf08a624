//! Checked sizes and shapes in the engine's terms.
//!
//! Input: types of check. Output: shapes of the model. Invariant: sizes have the same numbers in both.

use crate::checked::{Extent, Group, Type};
use hamiltonian_symbolic::index::Affine;
use hamiltonian_symbolic::model::Shape;

/// A shape.
pub fn shape(ty: Type) -> Shape {
    match ty {
        Type::Bool | Type::Scalar => Shape::Scalar,
        Type::Vector(rows) => Shape::Vector(rows.affine()),
        Type::Matrix(rows, columns) => Shape::Matrix(rows.affine(), columns.affine()),
        Type::Array(_) => Shape::Vector(ty.elements().unwrap_or_default()),
    }
}

/// The extents of the axes of a lattice, row after row; none of other groups.
pub fn axes(group: &Group) -> Vec<Affine> {
    let extents = group.ty.extents().into_iter();
    match group.is_lattice {
        true => extents.map(Extent::affine).collect(),
        false => Vec::new(),
    }
}

/// The shape of a group of coordinates: a lattice is a vector of its elements, the columns of
/// another matrix are literal. `None` if they are not; `check` refuses that.
pub fn group_shape(group: &Group) -> Option<Shape<u16>> {
    if group.is_lattice {
        return Some(Shape::Vector(group.ty.elements()?));
    }
    Some(match group.ty {
        Type::Bool | Type::Scalar => Shape::Scalar,
        Type::Vector(rows) => Shape::Vector(rows.affine()),
        Type::Matrix(rows, Extent::Literal(columns)) => {
            Shape::Matrix(rows.affine(), u16::try_from(columns).ok()?)
        }
        Type::Matrix(_, Extent::Size(_)) | Type::Array(_) => return None,
    })
}
