//! The change of a function of the state.
//!
//! Input: values of the function. Output: the largest and the mean change. Invariant: only sums and the maximum are
//! stored.

use crate::errors::Error;
use crate::results::checkpoint::Memory;
use hamiltonian_lanes::Real;

/// The largest change of a function of the state since the observer was attached.
///
/// Where the state or the system of the run is changed, the change of the function is added to f₀ and counts as no drift.
///
/// Differences are taken in the run's scalar, then rounded to `f64`.
#[derive(Debug, Clone, PartialEq)]
pub struct Deviation<T> {
    pub(crate) start: T,
    pub(crate) count: u64,
    pub(crate) max: f64,
    pub(crate) sum_of_sizes: f64,
    pub(crate) sum: f64,
}

impl<T: Real> Deviation<T> {
    pub(crate) fn new(start: T) -> Self {
        Deviation {
            start,
            count: 0,
            max: 0.0,
            sum_of_sizes: 0.0,
            sum: 0.0,
        }
    }

    pub(crate) fn record(&mut self, value: T) {
        let change = (value - self.start).to_f64();
        let size = if change < 0.0 { -change } else { change };
        self.count += 1;
        // A NaN must remain; `f64::max` would drop it.
        if size > self.max || size.is_nan() {
            self.max = size;
        }
        self.sum_of_sizes += size;
        self.sum += change;
    }

    /// Adds a change of the function that is no drift to the reference. The mean of f stays.
    pub(crate) fn shift(&mut self, change: T) {
        self.start += change;
        self.sum -= change.to_f64() * self.count as f64;
    }

    pub(crate) fn save(&self, to: &mut Memory) {
        to.scalar(self.start);
        to.count(self.count);
        for number in [self.max, self.sum_of_sizes, self.sum] {
            to.number(number);
        }
    }

    pub(crate) fn restored(from: &mut Memory) -> Result<Self, Error> {
        Ok(Deviation {
            start: from.read_scalar()?,
            count: from.read_count()?,
            max: from.read_number()?,
            sum_of_sizes: from.read_number()?,
            sum: from.read_number()?,
        })
    }

    /// The reference f₀: the value at the state at which the observer was attached, and the changes that the run was given.
    pub fn start(&self) -> T {
        self.start
    }

    /// The number of received states.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// max |f − f₀|.
    pub fn max_absolute(&self) -> f64 {
        self.max
    }

    /// max |f/f₀ − 1|; infinite or NaN when f₀ = 0.
    pub fn max_relative(&self) -> f64 {
        self.max / self.scale()
    }

    /// The mean of |f − f₀|.
    pub fn mean_absolute(&self) -> f64 {
        self.sum_of_sizes / self.count as f64
    }

    /// The mean of |f/f₀ − 1|; infinite or NaN when f₀ = 0.
    pub fn mean_relative(&self) -> f64 {
        self.mean_absolute() / self.scale()
    }

    /// The mean of f.
    pub fn mean(&self) -> f64 {
        self.start.to_f64() + self.sum / self.count as f64
    }

    /// |f₀|.
    fn scale(&self) -> f64 {
        Real::abs(self.start.to_f64())
    }
}
