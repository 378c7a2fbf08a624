//! A function of the state whose drift lanes follow: H or an observable.

use crate::systems::system::Description;

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
    pub(crate) fn reads(self, system: &Description) -> [bool; 2] {
        let Quantity::Observable(index) = self else {
            return [true; 2];
        };
        // A scheme may carry the time as a coordinate or as a momentum.
        let declared = system.observables.get(index);
        let declared = declared.filter(|observable| !observable.depends_on_time);
        declared.map_or([true; 2], |observable| observable.reads)
    }
}
