//! The members in the lanes of a pack, over their own scalar.
//!
//! Input: a host. Output: the numbers of each lane, for the pack. Invariants: a lane without a member repeats
//! the numbers of an occupied one, so that it computes with valid numbers. Members that failed in a block
//! are pending until the end, when they are replayed together, step by step.

use super::seat::{Host, Seat};
use crate::observe::Deviation;
use crate::state::State;
use crate::system::System;
use alloc::vec::Vec;
use hamiltonian_lanes::Real;

/// The members in the lanes of a pack, and those pending for replay.
pub(crate) struct Crew<T: Real, S: System<T>> {
    seats: Vec<Option<Seat<T, S>>>,
    place: Vec<Place>,
    /// Members that failed in a block of steps and are pending for replay.
    suspects: Vec<Seat<T, S>>,
    /// True if the members in the lanes are replayed step by step.
    careful: bool,
    /// True if the host has members left.
    more: bool,
    /// True if any member so far has an observer whose quantities the lanes evaluate.
    follows: bool,
    change: Option<Change>,
}

/// The occupation of a lane.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Place {
    /// No member; the seat of a previous one may be kept for reuse.
    Empty,
    /// A member that was loaded since the last block.
    New,
    /// A member under way.
    Under,
    /// A member that leaves.
    Leaving,
}

/// The steps after which the observers of lanes receive states.
#[derive(Debug, Clone, Default)]
pub(crate) struct Schedule {
    /// The steps to the first.
    pub(crate) first: u64,
    /// The steps between two of them.
    pub(crate) interval: u64,
    /// The steps to the first state and between two states, lane by lane, if the lanes differ; 0 for a lane
    /// whose observer receives none.
    pub(crate) apart: Option<[Vec<u64>; 2]>,
}

/// An interval longer than any run: the observer receives no further state.
const NEVER: u64 = 1 << 53;

/// Returns the greatest common divisor.
fn divisor(a: u64, b: u64) -> u64 {
    match b {
        0 => a,
        b => divisor(b, a % b),
    }
}

/// The differences between a crew and the previous one.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Change {
    /// Parameters may differ.
    pub(crate) parameters: bool,
    /// At least one member is at its start.
    pub(crate) some_fresh: bool,
    /// All members are at their starts.
    pub(crate) all_fresh: bool,
}

impl<T: Real, S: System<T>> Crew<T, S> {
    pub(crate) fn new(lanes: usize) -> Self {
        Crew {
            seats: (0..lanes).map(|_| None).collect(),
            place: alloc::vec![Place::Empty; lanes],
            suspects: Vec::new(),
            careful: false,
            more: true,
            follows: false,
            change: None,
        }
    }

    /// Fills the empty lanes. Returns true if any member is left.
    pub(crate) fn fill(&mut self, host: &mut dyn Host<T, S>) -> bool {
        let mut some = false;
        // The observer of a new member receives states after the same steps as the others.
        let interval = self.interval();
        let is_aligned = self.phase() == host.phase() % interval;
        let is_empty = self.under().next().is_none();
        for (seat, place) in self.seats.iter_mut().zip(&mut self.place) {
            if *place == Place::Empty && (is_aligned || is_empty) {
                self.more = self.more && host.load(seat);
                if let Some(seat) = seat.as_ref().filter(|_| self.more) {
                    self.follows |= !seat.follows.is_empty();
                    *place = Place::New;
                    self.change.get_or_insert_default();
                }
            }
            some |= *place != Place::Empty;
        }
        if some {
            return true;
        }
        // Pending members are replayed last, step by step.
        self.careful = true;
        for (seat, place) in self.seats.iter_mut().zip(&mut self.place) {
            let Some(suspect) = self.suspects.pop() else {
                break;
            };
            *seat = Some(suspect);
            *place = Place::New;
            self.change.get_or_insert_default();
            some = true;
        }
        some
    }

    /// Returns the seats whose numbers are in the lanes. A lane without a member repeats the first occupied one.
    pub(crate) fn seats(&self) -> Vec<&Seat<T, S>> {
        let taken = |lane: usize| {
            let is_taken = self.place[lane] != Place::Empty;
            self.seats[lane].as_ref().filter(|_| is_taken)
        };
        let mut seats = Vec::with_capacity(self.place.len());
        if let Some(stand_in) = (0..self.place.len()).find_map(taken) {
            seats.extend((0..self.place.len()).map(|lane| taken(lane).unwrap_or(stand_in)));
        }
        seats
    }

    /// Returns true if the crew has changed.
    pub(crate) fn has_changed(&self) -> bool {
        self.change.is_some()
    }

    /// Returns the change of the crew since the last call.
    pub(crate) fn changed(&mut self) -> Option<Change> {
        let mut change = self.change.take()?;
        change.all_fresh = true;
        for (seat, place) in self.seats.iter_mut().zip(&self.place) {
            if let Some(seat) = seat.as_mut().filter(|_| *place != Place::Empty) {
                change.parameters |= core::mem::take(&mut seat.other);
                let is_fresh = seat.made == 0;
                change.some_fresh |= is_fresh;
                change.all_fresh &= is_fresh;
            }
        }
        Some(change)
    }

    /// Writes the carried values of new members into their columns of the rows, and repeats a column in empty
    /// lanes.
    pub(crate) fn write_columns(&mut self, rows: &mut [T]) {
        let lanes = self.place.len();
        let mut stand_in = None;
        for (lane, (seat, place)) in self.seats.iter().zip(&mut self.place).enumerate() {
            let Some(seat) = seat.as_ref().filter(|_| *place != Place::Empty) else {
                continue;
            };
            stand_in = stand_in.or(Some(lane));
            if *place == Place::New {
                for (row, word) in rows.chunks_exact_mut(lanes).zip(&seat.words) {
                    row[lane] = *word;
                }
                *place = Place::Under;
            }
        }
        let Some(stand_in) = stand_in else { return };
        for (lane, place) in self.place.iter().enumerate() {
            if *place == Place::Empty {
                for row in rows.chunks_exact_mut(lanes) {
                    row[lane] = row[stand_in];
                }
            }
        }
    }

    /// Returns the number of steps of the next block, which ends at the next stop of a member or before.
    pub(crate) fn steps(&self, most: u64, host: &dyn Host<T, S>) -> u64 {
        let most = if self.careful { 1 } else { most };
        let left = self.under().map(|seat| seat.stop.saturating_sub(seat.made));
        let most = left.fold(most, u64::min);
        match self.more && self.place.contains(&Place::Empty) {
            // The block ends at the step at which empty lanes may be refilled.
            true => {
                let interval = self.interval();
                let ahead = interval + host.phase() % interval - self.phase();
                most.min((ahead - 1) % interval + 1)
            }
            false => most,
        }
    }

    /// The members under way.
    fn under(&self) -> impl Iterator<Item = &Seat<T, S>> {
        let taken = self.seats.iter().zip(&self.place);
        taken.filter_map(|(seat, place)| seat.as_ref().filter(|_| *place == Place::Under))
    }

    /// Counts the steps made.
    pub(crate) fn made(&mut self, n: u64) {
        for (seat, place) in self.seats.iter_mut().zip(&self.place) {
            if let Some(seat) = seat.as_mut().filter(|_| *place == Place::Under) {
                seat.made += n;
            }
        }
    }

    /// The members under way whose drift is followed.
    fn followed(&self) -> impl Iterator<Item = &Seat<T, S>> {
        let any = self.follows.then(|| self.under()).into_iter().flatten();
        any.filter(|seat| !seat.follows.drifts.is_empty())
    }

    /// Returns the steps between two states of the first member whose drift is followed.
    fn interval(&self) -> u64 {
        let followed = self.followed().next();
        followed.map_or(1, |seat| seat.interval.max(1))
    }

    /// Returns the steps since the last such state.
    fn phase(&self) -> u64 {
        let followed = self.followed().next();
        followed.map_or(0, |seat| seat.made % seat.interval.max(1))
    }

    /// Returns the steps after which the observers of the lanes receive states.
    pub(crate) fn schedule(&self) -> Schedule {
        let (interval, first) = (self.interval(), self.interval() - self.phase());
        let ahead = |seat: &Seat<T, S>| {
            let interval = seat.interval.max(1);
            [interval - seat.made % interval, interval]
        };
        // Signs are followed from step to step.
        let watches = self.follows && self.under().any(|seat| !seat.follows.sections.is_empty());
        let is_due = !watches || (first, interval) == (1, 1);
        if is_due && self.followed().all(|seat| ahead(seat) == [first, interval]) {
            return Schedule {
                first,
                interval,
                apart: None,
            };
        }
        let mut lanes = [(); 2].map(|()| alloc::vec![0; self.place.len()]);
        let mut common = u64::from(watches);
        for (lane, (seat, place)) in self.seats.iter().zip(&self.place).enumerate() {
            let Some(seat) = seat.as_ref().filter(|_| *place == Place::Under) else {
                continue;
            };
            if seat.follows.drifts.is_empty() || seat.interval >= NEVER {
                continue;
            }
            for (lanes, steps) in lanes.iter_mut().zip(ahead(seat)) {
                lanes[lane] = steps;
                common = divisor(steps, common);
            }
        }
        let common = common.max(1);
        Schedule {
            first: common,
            interval: common,
            apart: Some(lanes),
        }
    }

    /// Records that drifts have begun.
    pub(crate) fn attached(&mut self) {
        for seat in self.seats.iter_mut().flatten() {
            for track in &mut seat.follows.drifts {
                track.drift.get_or_insert_with(|| Deviation {
                    count: 1,
                    ..Deviation::new(T::zero())
                });
            }
        }
    }

    /// Writes the numbers of drift `k` of each lane into the seats.
    pub(crate) fn write_track(&mut self, k: usize, lanes: &[Vec<T>; 4]) {
        for (lane, (seat, place)) in self.seats.iter_mut().zip(&self.place).enumerate() {
            let Some(seat) = seat.as_mut().filter(|_| *place == Place::Under) else {
                continue;
            };
            let Some(Some(drift)) = seat.follows.drifts.get_mut(k).map(|track| &mut track.drift)
            else {
                continue;
            };
            drift.start = lanes[0][lane];
            drift.sum_of_sizes = lanes[2][lane].to_f64();
            drift.max = match drift.sum_of_sizes.is_nan() {
                true => drift.sum_of_sizes,
                false => lanes[1][lane].to_f64(),
            };
            drift.sum = lanes[3][lane].to_f64();
            let interval = seat.interval.max(1);
            drift.count += seat.made / interval - seat.since / interval;
        }
    }

    /// Records that the drifts are up to date.
    pub(crate) fn tracks_written(&mut self) {
        for seat in self.seats.iter_mut().flatten() {
            seat.since = seat.made;
        }
    }

    /// Removes a member from its lane. Returns it, and true if it was being replayed.
    pub(crate) fn take(&mut self, lane: usize) -> Option<(Seat<T, S>, bool)> {
        if core::mem::replace(&mut self.place[lane], Place::Empty) == Place::Empty {
            return None;
        }
        self.change.get_or_insert_default();
        Some((self.seats[lane].take()?, self.careful))
    }

    /// Makes a member pending for replay.
    pub(crate) fn suspect(&mut self, mut seat: Seat<T, S>) {
        seat.other = true;
        self.suspects.push(seat);
    }

    /// Returns true if a member is at its stop.
    pub(crate) fn is_any_due(&self) -> bool {
        self.under().any(|seat| seat.made == seat.stop)
    }

    /// Writes a number of each lane into the states of the members at their stops.
    #[inline(always)]
    pub(crate) fn show(&mut self, numbers: &[T], to: impl Fn(&mut State<S::Vector>) -> &mut T) {
        for ((seat, place), number) in self.seats.iter_mut().zip(&self.place).zip(numbers) {
            let under = seat.as_mut().filter(|_| *place == Place::Under);
            if let Some(seat) = under.filter(|seat| seat.made == seat.stop) {
                *to(&mut seat.state) = *number;
            }
        }
    }

    /// Calls a function with each member at its stop. The function returns true if the member stays.
    pub(crate) fn for_each_due(&mut self, mut of: impl FnMut(usize, &mut Seat<T, S>) -> bool) {
        for (lane, (seat, place)) in self.seats.iter_mut().zip(&mut self.place).enumerate() {
            let under = seat.as_mut().filter(|_| *place == Place::Under);
            if let Some(seat) = under.filter(|seat| seat.made == seat.stop)
                && !of(lane, seat)
            {
                *place = Place::Leaving;
            }
        }
    }

    /// Returns true if a member at its stop after `n` more steps has an observer of signs.
    pub(crate) fn is_any_watched_due(&self, n: u64) -> bool {
        let mut due = self.under().filter(|seat| seat.made + n == seat.stop);
        due.any(|seat| !seat.follows.sections.is_empty())
    }

    /// Calls a function with each member under way whose observer follows signs. The function returns true if
    /// the member stays.
    pub(crate) fn for_each_watched(&mut self, mut of: impl FnMut(usize, &mut Seat<T, S>) -> bool) {
        for (lane, (seat, place)) in self.seats.iter_mut().zip(&mut self.place).enumerate() {
            let under = seat.as_mut().filter(|_| *place == Place::Under);
            if let Some(seat) = under.filter(|seat| !seat.follows.sections.is_empty())
                && !of(lane, seat)
            {
                *place = Place::Leaving;
            }
        }
    }

    /// Records that the followed quantities of a member have changed.
    pub(crate) fn follows_other(&mut self) {
        self.follows = true;
        self.change.get_or_insert_default();
    }

    /// Returns true if a member leaves.
    pub(crate) fn is_any_leaving(&self) -> bool {
        self.place.contains(&Place::Leaving)
    }

    /// Returns leaving members to the host, with their carried values.
    pub(crate) fn leave(&mut self, rows: &[T], host: &mut dyn Host<T, S>) {
        let lanes = self.place.len();
        for (lane, (seat, place)) in self.seats.iter_mut().zip(&mut self.place).enumerate() {
            if *place != Place::Leaving {
                continue;
            }
            *place = Place::Empty;
            self.change.get_or_insert_default();
            let Some(seat) = seat else { continue };
            for (row, word) in rows.chunks_exact(lanes).zip(&mut seat.words) {
                *word = row[lane];
            }
            host.leave(seat);
        }
    }
}
