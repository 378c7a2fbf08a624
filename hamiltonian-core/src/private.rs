//! The only paths that code emitted by `hamiltonian!` names.
//!
//! Input: nothing. Output: re-exports and [`Never`]. Invariant: what is here may be named by code
//! in a crate that has neither this crate nor its dependencies in scope; nothing is removed or
//! renamed without the macro changing with it.

pub extern crate alloc;
pub use core;

pub use hamiltonian_lanes::{Lift, Mask, Real};
pub use nalgebra::{
    self, ArrayStorage, Const, DVector, Dyn, Matrix, OMatrix, SMatrix, SVector, VecStorage,
};

pub use crate::error::Error;
pub use crate::state::{Gradient, State};
pub use crate::system::{
    Autonomous, Cyclic, Drift, Dynamics, Flow, Group, Kick, Observable, ObservableKind,
    QuadraticKinetic, Separable, System,
};
pub use crate::vector::{IntoVector, Vector};

/// A kick, a drift or a flow that cannot exist: what a structure's associated types are on a
/// system that does not have the structure.
#[derive(Debug, Clone, Copy)]
pub enum Never {}

impl<V: Vector> Kick<V> for Never {
    fn kick(&self, _: V::Scalar, _: &V, _: &mut V) {
        match *self {}
    }
}

impl<V: Vector> Drift<V> for Never {
    fn drift(&self, _: V::Scalar, _: &V, _: &mut V) {
        match *self {}
    }
}

impl<V: Vector> Flow<V> for Never {
    fn flow(&self, _: V::Scalar, _: &V, _: &V, _: &mut V, _: &mut V) {
        match *self {}
    }
}
