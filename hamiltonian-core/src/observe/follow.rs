//! What observers follow that lanes can follow for them.
//!
//! Input: observers. Output: the quantities whose drift or sign they follow, and back the drift. Invariant:
//! an observer that lanes follow sees what it would see state by state, in the arithmetic of the lanes.

use super::deviation::Deviation;
use super::quantity::Quantity;
use super::section::Section;
use alloc::vec::Vec;
use hamiltonian_lanes::Real;

/// A quantity of a member, and its drift so far.
#[derive(Debug, Clone)]
pub struct Track<T> {
    pub(crate) quantity: Quantity,
    /// None before the first state.
    pub(crate) drift: Option<Deviation<T>>,
}

/// All that lanes follow for an observer.
#[derive(Debug, Clone)]
pub struct Follows<T> {
    pub(crate) drifts: Vec<Track<T>>,
    pub(crate) sections: Vec<Section<T>>,
}

impl<T> Default for Follows<T> {
    fn default() -> Self {
        Follows {
            drifts: Vec::new(),
            sections: Vec::new(),
        }
    }
}

impl<T> Follows<T> {
    pub(crate) fn is_empty(&self) -> bool {
        self.drifts.is_empty() && self.sections.is_empty()
    }
}

/// A visitor of what an observer follows, see [`Observer::follow`](crate::Observer::follow).
#[derive(Debug)]
pub struct Follower<T> {
    follows: Follows<T>,
    /// The drift that is given back next; none while they are taken.
    back: Option<usize>,
}

impl<T: Real> Follower<T> {
    /// Takes all that an observer follows, if lanes can follow it: nothing otherwise. The storage of `into` is
    /// used again.
    pub(crate) fn take(into: &mut Follows<T>, follow: impl FnOnce(&mut Self) -> bool) {
        let mut follows = core::mem::take(into);
        follows.drifts.clear();
        follows.sections.clear();
        let mut follower = Follower {
            follows,
            back: None,
        };
        let is_all = follow(&mut follower);
        let Follows { drifts, sections } = &mut follower.follows;
        // Lanes go on for some steps after an event that ends a member, and drifts would too.
        let outlive = !drifts.is_empty() && sections.iter().any(|section| section.ends);
        if !is_all || outlive {
            drifts.clear();
            sections.clear();
        }
        *into = follower.follows;
    }

    /// Gives the drifts back.
    pub(crate) fn give(follows: &mut Follows<T>, follow: impl FnOnce(&mut Self) -> bool) {
        let mut follower = Follower {
            follows: core::mem::take(follows),
            back: Some(0),
        };
        follow(&mut follower);
        *follows = follower.follows;
    }

    /// Visits a function whose sign is followed.
    pub(crate) fn section(&mut self, section: Section<T>) {
        if self.back.is_none() {
            self.follows.sections.push(section);
        }
    }

    /// Returns true if signs are followed.
    pub(crate) fn has_sections(&self) -> bool {
        !self.follows.sections.is_empty()
    }

    /// Visits a drift.
    pub(crate) fn drift(&mut self, quantity: Quantity, drift: &mut Option<Deviation<T>>) {
        match &mut self.back {
            Some(index) => {
                if let Some(track) = self.follows.drifts.get(*index) {
                    drift.clone_from(&track.drift);
                }
                *index += 1;
            }
            None => self.follows.drifts.push(Track {
                quantity,
                drift: drift.clone(),
            }),
        }
    }
}

/// The drifts of a quantity in lanes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tracker<U> {
    pub(crate) quantity: Quantity,
    pub(crate) start: U,
    pub(crate) max: U,
    pub(crate) sizes: U,
    pub(crate) sum: U,
}

impl<U: Real> Tracker<U> {
    /// A drift whose numbers are yet to be written.
    pub(crate) fn new(quantity: Quantity) -> Self {
        Tracker {
            quantity,
            start: U::zero(),
            max: U::zero(),
            sizes: U::zero(),
            sum: U::zero(),
        }
    }

    /// Its numbers: the first value, the largest size, the sum of sizes, the sum.
    #[inline(always)]
    pub(crate) fn numbers(&self) -> [&U; 4] {
        [&self.start, &self.max, &self.sizes, &self.sum]
    }

    /// Its numbers, to be written.
    #[inline(always)]
    pub(crate) fn numbers_mut(&mut self) -> [&mut U; 4] {
        [
            &mut self.start,
            &mut self.max,
            &mut self.sizes,
            &mut self.sum,
        ]
    }

    /// Begins some lanes with their first value, or records the value of those that are due.
    #[inline(always)]
    pub(crate) fn follow(&mut self, begins: Option<U::Mask>, due: Option<U::Mask>, value: U) {
        match begins {
            Some(lanes) => self.begin(lanes, value),
            None => self.record(due, value),
        }
    }

    /// Begins some lanes with their first value.
    #[inline(always)]
    fn begin(&mut self, lanes: U::Mask, value: U) {
        self.start = U::select(lanes, value, self.start);
        for sum in [&mut self.max, &mut self.sizes, &mut self.sum] {
            *sum = U::select(lanes, U::zero(), *sum);
        }
    }

    /// As [`Deviation`] does, lane by lane: all of them, or those that are due.
    #[inline(always)]
    fn record(&mut self, due: Option<U::Mask>, value: U) {
        let mut change = value - self.start;
        if let Some(due) = due {
            // A drift of 0 changes no bit of the others.
            change = U::select(due, change, U::zero());
        }
        let size = change.abs();
        // A NaN is lost here, and stays in the sum of sizes.
        self.max = U::select(self.max.lt(size), size, self.max);
        self.sizes += size;
        self.sum += change;
    }
}
