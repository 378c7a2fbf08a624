//! What observers follow that lanes can follow for them.
//!
//! Input: observers. Output: the quantities whose drift they follow, and back the drift. Invariant: an
//! observer that lanes follow sees what it would see state by state, in the arithmetic of the lanes.

use crate::observe::Deviation;
use crate::state::State;
use crate::system::{Dynamics, System, declared_energy};
use alloc::vec::Vec;
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

/// A quantity of a member, and its drift so far.
#[derive(Debug, Clone)]
pub struct Track<T> {
    pub(crate) quantity: Quantity,
    /// None before the first state.
    pub(crate) drift: Option<Deviation<T>>,
}

/// A visitor of the drifts in an observer, see [`Observer::follow`](crate::Observer::follow).
#[derive(Debug)]
pub struct Follower<T> {
    tracks: Vec<Track<T>>,
    /// The track that is given back next; none while they are taken.
    back: Option<usize>,
}

impl<T: Real> Follower<T> {
    /// Takes all drifts of an observer; `None` if it follows anything else.
    pub(crate) fn take(follow: impl FnOnce(&mut Self) -> bool) -> Option<Vec<Track<T>>> {
        let mut follower = Follower {
            tracks: Vec::new(),
            back: None,
        };
        follow(&mut follower).then_some(follower.tracks)
    }

    /// Gives the drifts back.
    pub(crate) fn give(tracks: Vec<Track<T>>, follow: impl FnOnce(&mut Self) -> bool) {
        let mut follower = Follower {
            tracks,
            back: Some(0),
        };
        follow(&mut follower);
    }

    /// Visits a drift.
    pub(crate) fn drift(&mut self, quantity: Quantity, drift: &mut Option<Deviation<T>>) {
        match &mut self.back {
            Some(index) => {
                if let Some(track) = self.tracks.get(*index) {
                    drift.clone_from(&track.drift);
                }
                *index += 1;
            }
            None => self.tracks.push(Track {
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
    /// Begins some lanes with their first value.
    #[inline(always)]
    pub(crate) fn begin(&mut self, lanes: U::Mask, value: U) {
        self.start = U::select(lanes, value, self.start);
        for sum in [&mut self.max, &mut self.sizes, &mut self.sum] {
            *sum = U::select(lanes, U::zero(), *sum);
        }
    }

    /// As [`Deviation`] does, lane by lane: all of them, or those that are due.
    #[inline(always)]
    pub(crate) fn record(&mut self, due: Option<U::Mask>, value: U) {
        let mut change = value - self.start;
        if let Some(due) = due {
            // A drift of 0 changes no bit of the others.
            change = U::select(due, change, U::zero());
        }
        let size = U::select(change.lt(U::zero()), -change, change);
        // A NaN stays.
        let grows = self.max.lt(size) | !size.equals(size);
        self.max = U::select(grows, size, self.max);
        self.sizes += size;
        self.sum += change;
    }
}
