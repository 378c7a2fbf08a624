//! Checked sizes and shapes in the engine's terms.
//!
//! Input: what check resolved. Output: affine forms, shapes. Invariant: size `n` of
//! the one is size `n` of the other.

use crate::checked::{Extent, Type};
use hamiltonian_symbolic::index::{Affine, Size};
use hamiltonian_symbolic::model::Shape;

/// An extent.
pub fn size_affine(extent: Extent) -> Affine {
    match extent {
        Extent::Literal(value) => {
            Affine::constant(i64::try_from(value).expect("check bounds literal sizes"))
        }
        Extent::Size(size) => Affine::size(Size(size.0 as u16)),
    }
}

/// A shape.
pub fn shape(ty: Type) -> Shape {
    match ty {
        Type::Bool | Type::Scalar => Shape::Scalar,
        Type::Vector(rows) => Shape::Vector(size_affine(rows)),
        Type::Matrix(rows, columns) => Shape::Matrix(size_affine(rows), size_affine(columns)),
    }
}

/// The shape of a group of coordinates, whose columns are literal; `None` where they are not, which
/// check refuses.
pub fn group_shape(ty: Type) -> Option<Shape<u16>> {
    Some(match ty {
        Type::Bool | Type::Scalar => Shape::Scalar,
        Type::Vector(rows) => Shape::Vector(size_affine(rows)),
        Type::Matrix(rows, Extent::Literal(columns)) => {
            Shape::Matrix(size_affine(rows), u16::try_from(columns).ok()?)
        }
        Type::Matrix(_, Extent::Size(_)) => return None,
    })
}
