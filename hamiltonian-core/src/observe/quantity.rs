//! A function of the state that lanes follow.
//!
//! Input: a state. Output: H or an observable there, over any scalar.

use crate::state::State;
use crate::system::{Dynamics, System, declared_energy};
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
        state: &State<S::Vector>,
    ) -> T {
        match self {
            Quantity::Energy => declared_energy::<T, S>(prepared, state),
            Quantity::Observable(index) => prepared.observable(index, state.t, &state.q, &state.p),
        }
    }
}
