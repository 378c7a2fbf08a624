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
    /// True if it reads coordinates, and the same for momenta.
    pub(crate) fn reads<T: Real, S: System<T>>(self) -> [bool; 2] {
        let Quantity::Observable(index) = self else {
            return [true; 2];
        };
        // The time may be carried with either.
        let declared = S::OBSERVABLES.get(index);
        let is_timed = declared.is_none_or(|observable| observable.depends_on_time);
        let reads = S::READS.get(index).filter(|_| !is_timed);
        reads.copied().unwrap_or([true; 2])
    }

    /// Its value.
    #[inline(always)]
    pub(crate) fn at<T: Real, S: System<T>>(
        self,
        prepared: &S::Prepared,
        t: T,
        point: &Point<S::Vector>,
    ) -> T {
        match self {
            Quantity::Energy => declared_energy_at::<T, S>(prepared, t, &point.q, &point.p),
            Quantity::Observable(_) => self.observed::<T, S>(prepared, t, point),
        }
    }

    /// The value of an observable; 0 for H.
    #[inline(always)]
    pub(crate) fn observed<T: Real, S: System<T>>(
        self,
        prepared: &S::Prepared,
        t: T,
        point: &Point<S::Vector>,
    ) -> T {
        match self {
            Quantity::Energy => T::zero(),
            Quantity::Observable(index) => prepared.observable(index, t, &point.q, &point.p),
        }
    }
}
