//! The structure of H that schemes require, as traits.
//!
//! Input: a [`System`]. Output: its pieces, of which schemes make exact flows. Invariant: the macro implements a trait
//! only if it has proven the structure.

use super::{System, VectorOf};
use crate::systems::flow::{Piece, Pieces};
use crate::systems::state::Point;
use hamiltonian_lanes::Real;

/// H is a sum of pieces with exact flows. Splittings require it.
///
/// Every [`Separable`] system implements it, with kick and drift as its pieces. So does every definition with declared
/// pieces, `split { A = …; B = …; }`, or for which the macro finds pieces. A force is part of the kick. Beside other
/// pieces, the force is a piece of its own, the innermost, `force`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not known to split into pieces with exact flows",
    label = "this scheme composes the flows of pieces of H",
    note = "in generic code bound the system, `S: Split`; every `S: Separable` splits too",
    note = "a system written by hand implements `Split`"
)]
pub trait Split: System {
    /// The pieces, the outermost first, in the order of [`Description::pieces`](super::Description::pieces).
    type Pieces<T: Real>: Pieces<T, Self::Prepared<T>, Point = Point<VectorOf<Self, T>>>;
    /// The pieces.
    fn pieces<T: Real>() -> Self::Pieces<T>;
}

/// H = T(p, t) + V(q, t), proven at compile time.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not known to be separable",
    label = "this scheme takes H = T(p, t) + V(q, t)",
    note = "in generic code bound the system, `S: Separable`",
    note = "a system written by hand implements `Separable`"
)]
pub trait Separable: System {
    /// V: its flow is `p −= c·∂V/∂q(q, t)`; with a force, `p += c·(f − ∂V/∂q)`.
    type Kick<T: Real>: Piece<T, Self::Prepared<T>, Point = Point<VectorOf<Self, T>>>;
    /// T: its flow is `q += c·∂T/∂p(p, t)`.
    type Drift<T: Real>: Piece<T, Self::Prepared<T>, Point = Point<VectorOf<Self, T>>>;
    /// The kick.
    fn kick<T: Real>() -> Self::Kick<T>;
    /// The drift.
    fn drift<T: Real>() -> Self::Drift<T>;
}

/// H = A(q, p) + V(q, t), with A at most quadratic in p and with an exact flow. Nyström schemes require it: then
/// {V, {V, {V, A}}} = 0.
///
/// The macro implements it if the two are the pieces of [`Split`], in either order, and if H is [`Separable`] with such
/// a T. Examples are T + V, and a potential with a uniform magnetic field or in a rotating frame. If H is separable, a
/// force that does not depend on p is part of the kick.
#[diagnostic::on_unimplemented(
    message = "H of `{Self}` is not known to be at most quadratic in p beside V(q, t)",
    label = "this scheme takes H = A(q, p) + V(q, t), with A at most quadratic in p",
    note = "in generic code bound the system, `S: Nystrom`",
    note = "a system written by hand implements `Nystrom`"
)]
pub trait Nystrom: System {
    /// V: its flow is `p −= c·∂V/∂q(q, t)`.
    type Kick<T: Real>: Piece<T, Self::Prepared<T>, Point = Point<VectorOf<Self, T>>>;
    /// A.
    type Quadratic<T: Real>: Piece<T, Self::Prepared<T>, Point = Point<VectorOf<Self, T>>>;
    /// The kick.
    fn kick<T: Real>() -> Self::Kick<T>;
    /// The piece that is at most quadratic in p.
    fn quadratic<T: Real>() -> Self::Quadratic<T>;
}

/// No force acts besides −∂H/∂q. Schemes that cannot integrate a force require it.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not known to be without forces",
    label = "this scheme integrates H alone",
    note = "in generic code bound the system, `S: Unforced`",
    note = "for a system written by hand without a force: `impl Unforced for … {{}}`"
)]
pub trait Unforced {}

/// The flows of all pieces are exact. Splittings with a table of coefficients require it. A force that is not
/// affine in p has no exact flow: [`Strang`](crate::schemes::Strang) and its like integrate it by a symmetric sub-step
/// of order 2.
#[diagnostic::on_unimplemented(
    message = "the pieces of `{Self}` are not known to have exact flows",
    label = "this scheme has an order above 2 with exact flows alone",
    note = "in generic code bound the system, `S: Exact`",
    note = "for a system written by hand whose flows are exact: `impl Exact for … {{}}`"
)]
pub trait Exact {}

/// T = ½ pᵀM⁻¹p with constant M, proven at compile time.
#[diagnostic::on_unimplemented(
    message = "T of `{Self}` is not known to be ½ pᵀM⁻¹p with constant M",
    label = "this scheme integrates second-order equations",
    note = "in generic code bound the system, `S: QuadraticKinetic`",
    note = "for a system written by hand: `impl QuadraticKinetic for … {{}}`"
)]
pub trait QuadraticKinetic {}

/// H does not depend on t, proven at compile time.
#[diagnostic::on_unimplemented(
    message = "H of `{Self}` is not known to be independent of t",
    label = "this needs an H that does not depend on t",
    note = "in generic code bound the system, `S: Autonomous`",
    note = "for a system written by hand: `impl Autonomous for … {{}}`"
)]
pub trait Autonomous {}
