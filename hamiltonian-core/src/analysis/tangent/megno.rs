//! The mean exponential growth of nearby orbits.
//!
//! Input: the growth of a deviation in stretches of steps. Output: its MEGNO. Invariant: a run and
//! the lanes of an ensemble do the same operations.

use hamiltonian_lanes::Real;

/// The growth of one deviation δ, in which time is counted in steps: Y(t) = (2/t) ∫₀ᵗ s d ln δ(s), and its mean.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Megno<T> {
    /// 2 ∫ s d ln δ.
    growth: T,
    /// Y.
    present: T,
    /// ∫ Y ds.
    area: T,
}

impl<T: Real> Megno<T> {
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(crate) fn new() -> Self {
        let zero = T::zero();
        Megno {
            growth: zero,
            present: zero,
            area: zero,
        }
    }

    /// Adds a stretch between two steps, in which ln δ grows by `logarithm`.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(crate) fn add(&mut self, [from, to]: [u64; 2], logarithm: T) {
        let (from, to) = (from as i64 as f64, to as i64 as f64);
        self.growth += T::constant(from + to, 0.0) * logarithm;
        let present = T::constant(1.0 / to, 0.0) * self.growth;
        self.area += T::constant(0.5 * (to - from), 0.0) * (self.present + present);
        self.present = present;
    }

    /// ∫ Y ds, from which [`mean`](Megno::mean) is computed.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(crate) fn area(&self) -> T {
        self.area
    }

    /// The mean of Y over `steps` steps.
    pub(crate) fn mean(area: T, steps: u64) -> T {
        area / T::constant(steps as i64 as f64, 0.0)
    }
}
