//! Quantities that lanes evaluate instead of observers.
//!
//! Input: observers. Output: the quantities whose drift or sign they follow. Drifts are written back to the observers.
//! Invariant: an observer then has the results that it would compute from each state, in the arithmetic of the lanes.

use super::deviation::Deviation;
use super::quantity::Quantity;
use super::section::MemberSection;
use crate::systems::system::Description;
use alloc::vec::Vec;
use hamiltonian_lanes::Real;

/// A quantity of a member, with its drift up to now.
#[derive(Debug, Clone)]
pub struct FollowedDrift<T> {
    pub(crate) quantity: Quantity,
    /// `None` before the first state.
    pub(crate) drift: Option<Deviation<T>>,
}

/// The quantities that lanes follow for an observer.
#[derive(Debug, Clone)]
pub struct FollowedQuantities<T> {
    pub(crate) drifts: Vec<FollowedDrift<T>>,
    pub(crate) sections: Vec<MemberSection<T>>,
}

impl<T> Default for FollowedQuantities<T> {
    fn default() -> Self {
        FollowedQuantities {
            drifts: Vec::new(),
            sections: Vec::new(),
        }
    }
}

impl<T> FollowedQuantities<T> {
    pub(crate) fn is_empty(&self) -> bool {
        self.drifts.is_empty() && self.sections.is_empty()
    }
}

/// A visitor of the quantities that an observer follows, see [`Observer::follow`](crate::Observer::follow).
#[derive(Debug)]
pub struct FollowVisitor<'a, T> {
    /// The system, which has the names of the observables.
    pub(crate) system: &'a Description,
    followed: FollowedQuantities<T>,
    /// The index of the drift that is written back next; `None` while quantities are listed.
    next_written: Option<usize>,
}

impl<'a, T: Real> FollowVisitor<'a, T> {
    /// Lists the quantities that an observer follows. The list is empty if lanes cannot follow all of them. The storage
    /// of `into` is reused.
    pub(crate) fn list(
        system: &'a Description,
        into: &mut FollowedQuantities<T>,
        follow: impl FnOnce(&mut Self) -> bool,
    ) {
        let mut followed = core::mem::take(into);
        followed.drifts.clear();
        followed.sections.clear();
        let mut visitor = FollowVisitor {
            system,
            followed,
            next_written: None,
        };
        let is_all = follow(&mut visitor);
        let FollowedQuantities { drifts, sections } = &mut visitor.followed;
        // Lanes make further steps after an event that ends a member, and drifts would include these steps.
        let would_overrun = !drifts.is_empty() && sections.iter().any(|section| section.ends);
        if !is_all || would_overrun {
            drifts.clear();
            sections.clear();
        }
        *into = visitor.followed;
    }

    /// Writes the drifts back to an observer.
    pub(crate) fn write_back(
        system: &'a Description,
        followed: &mut FollowedQuantities<T>,
        follow: impl FnOnce(&mut Self) -> bool,
    ) {
        let mut visitor = FollowVisitor {
            system,
            followed: core::mem::take(followed),
            next_written: Some(0),
        };
        follow(&mut visitor);
        *followed = visitor.followed;
    }

    /// Lists a function whose sign the observer follows.
    pub(crate) fn section(&mut self, section: MemberSection<T>) {
        if self.next_written.is_none() {
            self.followed.sections.push(section);
        }
    }

    /// Returns true if any function whose sign is followed was listed.
    pub(crate) fn has_sections(&self) -> bool {
        !self.followed.sections.is_empty()
    }

    /// Lists a drift, or writes it back.
    pub(crate) fn drift(&mut self, quantity: Quantity, drift: &mut Option<Deviation<T>>) {
        match &mut self.next_written {
            Some(index) => {
                if let Some(track) = self.followed.drifts.get(*index) {
                    drift.clone_from(&track.drift);
                }
                *index += 1;
            }
            None => self.followed.drifts.push(FollowedDrift {
                quantity,
                drift: drift.clone(),
            }),
        }
    }
}

/// The drift of a quantity in lanes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LaneDrift<U> {
    pub(crate) quantity: Quantity,
    pub(crate) start: U,
    pub(crate) max: U,
    pub(crate) sum_of_sizes: U,
    pub(crate) sum: U,
}

impl<U: Real> LaneDrift<U> {
    /// Creates a drift whose numbers, here `any`, are written later.
    pub(crate) fn new(quantity: Quantity, any: U) -> Self {
        LaneDrift {
            quantity,
            start: any,
            max: any,
            sum_of_sizes: any,
            sum: any,
        }
    }

    /// Returns its numbers: the first value, the largest size of a change, the sum of sizes, the sum of changes.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(crate) fn numbers(&self) -> [&U; 4] {
        [&self.start, &self.max, &self.sum_of_sizes, &self.sum]
    }

    /// Returns its numbers for writing.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(crate) fn numbers_mut(&mut self) -> [&mut U; 4] {
        [
            &mut self.start,
            &mut self.max,
            &mut self.sum_of_sizes,
            &mut self.sum,
        ]
    }

    /// Starts the drifts of the lanes `begins` at their first value, or records the value in lanes that are due.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(crate) fn follow(&mut self, begins: Option<U::Mask>, due: Option<U::Mask>, value: U) {
        match begins {
            Some(lanes) => self.begin(lanes, value),
            None => self.record(due, value),
        }
    }

    /// Starts the drifts of some lanes at their first value.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn begin(&mut self, lanes: U::Mask, value: U) {
        self.start = U::select(lanes, value, self.start);
        for sum in [&mut self.max, &mut self.sum_of_sizes, &mut self.sum] {
            *sum = U::replaced(lanes, U::zero(), *sum);
        }
    }

    /// Records a value as [`Deviation`] does, in all lanes or in those that are due.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn record(&mut self, due: Option<U::Mask>, value: U) {
        let mut change = value - self.start;
        if let Some(due) = due {
            // Adding a change of 0 does not change the bits of the other lanes.
            change = U::select(due, change, U::zero());
        }
        let size = change.abs();
        // A NaN is dropped here, but it remains in the sum of sizes.
        self.max = U::select(self.max.lt(size), size, self.max);
        self.sum_of_sizes += size;
        self.sum += change;
    }
}
