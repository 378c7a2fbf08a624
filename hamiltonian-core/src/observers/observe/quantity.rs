//! A function of the state whose drift lanes follow: H or an observable.

use crate::systems::system::System;

/// A function of the state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// The declared H.
    Energy,
    /// The observable with this index.
    Observable(usize),
}

impl Quantity {
    /// Returns whether it depends on coordinates, and whether it depends on momenta.
    pub(crate) fn reads<S: System>(self) -> [bool; 2] {
        let Quantity::Observable(index) = self else {
            return [true; 2];
        };
        // A scheme may carry the time as a coordinate or as a momentum.
        let declared = S::OBSERVABLES.get(index);
        let is_timed = declared.is_none_or(|observable| observable.depends_on_time);
        let reads = S::READS.get(index).filter(|_| !is_timed);
        reads.copied().unwrap_or([true; 2])
    }
}
