//! Pieces that cannot exist.
//!
//! Input: the point of a system. Output: [`Never`], the type of a structure that the system lacks. Invariant: it has no
//! value, so nothing of it is ever computed.

use crate::systems::flow::{Flow, Piece, Pieces};
use crate::systems::vector::Vector;
use core::convert::Infallible;
use core::marker::PhantomData;
use hamiltonian_lanes::Real;

/// A piece, a flow or pieces that cannot exist: a structure's associated types on a system
/// that does not have the structure.
#[derive(Debug)]
pub struct Never<X>(PhantomData<fn() -> X>, Infallible);

impl<X> Never<X> {
    /// Never evaluated.
    pub const PIECE: Self = panic!("the system does not have this structure");
}

impl<X> Clone for Never<X> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<X> Copy for Never<X> {}

impl<X: Vector> Flow<X> for Never<X> {
    const NAME: &'static str = "";
    type Work = ();
    fn apply(&self, _: X::Scalar, _: &mut X, _: &mut ()) {
        match self.1 {}
    }
}

impl<T: Real, P, X: Vector<Scalar = T>> Piece<T, P> for Never<X> {
    type Point = X;
    type Flow = Self;
    fn flow(&self, _: &P, _: T) -> Self {
        *self
    }
}

impl<T: Real, P, X: Vector<Scalar = T>> Pieces<T, P> for Never<X> {
    type Point = X;
    type Outer = Self;
    type Inner = Self;
    fn outer(&self, _: &P, _: T) -> Self {
        *self
    }
    fn inner(&self, _: &P, _: T, _: T) -> Self {
        *self
    }
}
