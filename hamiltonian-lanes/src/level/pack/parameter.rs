//! Packs as parameters.
//!
//! Input: a pack. Output: [`Parameter`]. Invariant: a pack has a value over itself alone.

use super::{Base, W};
use core::any::Any;
use hamiltonian_real::{Parameter, Real};

/// A pack has parameters of its own in each lane, for states over the same pack alone. Over another scalar they have no
/// value, so that a start there is refused.
impl<P: Base, const K: usize> Parameter for W<P, K> {
    #[inline(always)]
    fn into_real<T: Real>(self) -> T {
        let own: &dyn Any = &self;
        own.downcast_ref::<T>()
            .copied()
            .unwrap_or_else(|| T::constant(f64::NAN, 0.0))
    }
}
