//! A function of the state that lanes follow.
//!
//! Input: a state. Output: H or an observable there, over any scalar.

use crate::state::Point;
use crate::system::{Dynamics, System, declared_energy_at};
use hamiltonian_lanes::Real;

/// A function of the state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// H, as it was declared.
    Energy,
    /// The observable of that index.
    Observable(usize),
}

impl Quantity {
    #[inline(always)]
    pub(crate) fn at<T: Real, S: System<T>>(
        self,
        prepared: &S::Prepared,
        t: T,
        point: &Point<S::Vector>,
    ) -> T {
        let Point { q, p } = point;
        match self {
            Quantity::Energy => declared_energy_at::<T, S>(prepared, t, q, p),
            Quantity::Observable(index) => prepared.observable(index, t, q, p),
        }
    }
}
