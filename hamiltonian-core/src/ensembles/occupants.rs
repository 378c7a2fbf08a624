//! The members in the lanes of a pack, over their own scalar.
//!
//! Input: a host. Output: the numbers of each lane, for the pack. Invariants: a lane without a member repeats
//! the numbers of an occupied one, so that it computes with valid numbers. Members that failed in a block
//! are pending until the end, when they are replayed together, step by step.

use super::host::{Host, MemberRun};
use crate::observers::observe::Deviation;
use crate::systems::domain::inside;
use crate::systems::system::System;
use alloc::vec::Vec;
use hamiltonian_lanes::Real;

/// The members in the lanes of a pack, and those that will be replayed.
pub(crate) struct Occupants<T: Real, S: System> {
    runs: Vec<Option<MemberRun<T, S>>>,
    status: Vec<LaneStatus>,
    /// Members that failed in a block of steps and will be replayed.
    pending: Vec<MemberRun<T, S>>,
    /// True if the members in the lanes are being replayed, step by step.
    replaying: bool,
    /// True if the host has members left.
    has_more: bool,
    /// True if any member so far has an observer whose quantities the lanes evaluate.
    any_followed: bool,
    change: Option<OccupantChange>,
}

/// The occupation of a lane.
#[derive(Debug, Clone, Copy, PartialEq)]
enum LaneStatus {
    /// No member; the storage of a previous run may be kept for reuse.
    Empty,
    /// A member whose numbers are not yet in the lane.
    Loaded,
    /// A member whose run continues.
    Running,
    /// A member that returns to the host at the end of this block.
    Leaving,
}

/// The steps after which the observers of lanes receive states.
#[derive(Debug, Clone, Default)]
pub(crate) struct Schedule {
    /// The steps to the first such state.
    pub(crate) first: u64,
    /// The steps between two such states.
    pub(crate) interval: u64,
    /// The steps to the first state and between two states, lane by lane, if the lanes differ; 0 for a lane
    /// whose observer receives none.
    pub(crate) by_lane: Option<[Vec<u64>; 2]>,
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

/// The differences between the occupants and the previous ones.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct OccupantChange {
    /// Parameters may differ.
    pub(crate) parameters: bool,
    /// At least one member is at its start.
    pub(crate) any_at_start: bool,
    /// All members are at their starts.
    pub(crate) all_at_start: bool,
}

impl<T: Real, S: System> Occupants<T, S> {
    pub(crate) fn new(lanes: usize) -> Self {
        Occupants {
            runs: (0..lanes).map(|_| None).collect(),
            status: alloc::vec![LaneStatus::Empty; lanes],
            pending: Vec::new(),
            replaying: false,
            has_more: true,
            any_followed: false,
            change: None,
        }
    }

    /// Returns the number of lanes.
    pub(crate) fn lanes(&self) -> usize {
        self.status.len()
    }

    /// Fills the empty lanes. Returns true if any lane has a member.
    pub(crate) fn fill(&mut self, host: &mut dyn Host<T, S>) -> bool {
        let mut some = false;
        // A member is loaded only when its observer receives states after the same steps as the others.
        let interval = self.interval();
        let is_aligned = self.phase() == host.phase() % interval;
        let is_empty = self.running().next().is_none();
        for (run, status) in self.runs.iter_mut().zip(&mut self.status) {
            if *status == LaneStatus::Empty && (is_aligned || is_empty) {
                self.has_more = self.has_more && host.load(run);
                if let Some(run) = run.as_ref().filter(|_| self.has_more) {
                    self.any_followed |= !run.followed.is_empty();
                    *status = LaneStatus::Loaded;
                    self.change.get_or_insert_default();
                }
            }
            some |= *status != LaneStatus::Empty;
        }
        if some {
            return true;
        }
        // The host has no members left: those that failed are replayed.
        self.replaying = true;
        for (run, status) in self.runs.iter_mut().zip(&mut self.status) {
            let Some(next) = self.pending.pop() else {
                break;
            };
            *run = Some(next);
            *status = LaneStatus::Loaded;
            self.change.get_or_insert_default();
            some = true;
        }
        some
    }

    /// Returns the runs whose numbers are in the lanes. A lane without a member repeats the first occupied one.
    #[inline(never)]
    pub(crate) fn runs(&self) -> Vec<&MemberRun<T, S>> {
        let occupied = |lane: usize| {
            let is_occupied = self.status[lane] != LaneStatus::Empty;
            self.runs[lane].as_ref().filter(|_| is_occupied)
        };
        let mut runs = Vec::with_capacity(self.status.len());
        if let Some(stand_in) = (0..self.status.len()).find_map(occupied) {
            runs.extend((0..self.status.len()).map(|lane| occupied(lane).unwrap_or(stand_in)));
        }
        runs
    }

    /// Returns true if the occupants have changed.
    pub(crate) fn has_changed(&self) -> bool {
        self.change.is_some()
    }

    /// Returns the change of the occupants since the last call, if there is one.
    pub(crate) fn changed(&mut self) -> Option<OccupantChange> {
        let mut change = self.change.take()?;
        change.all_at_start = true;
        for (run, status) in self.runs.iter_mut().zip(&self.status) {
            if let Some(run) = run.as_mut().filter(|_| *status != LaneStatus::Empty) {
                change.parameters |= core::mem::take(&mut run.system_changed);
                let is_at_start = run.made == run.began;
                change.any_at_start |= is_at_start;
                change.all_at_start &= is_at_start;
            }
        }
        Some(change)
    }

    /// Writes the carried values of new members into their columns of the rows. Columns of empty lanes repeat that of
    /// an occupied one.
    pub(crate) fn write_columns(&mut self, rows: &mut [T]) {
        let lanes = self.status.len();
        let mut stand_in = None;
        for (lane, (run, status)) in self.runs.iter().zip(&mut self.status).enumerate() {
            let Some(run) = run.as_ref().filter(|_| *status != LaneStatus::Empty) else {
                continue;
            };
            stand_in = stand_in.or(Some(lane));
            if *status == LaneStatus::Loaded {
                for (row, word) in rows.chunks_exact_mut(lanes).zip(&run.words) {
                    row[lane] = *word;
                }
                *status = LaneStatus::Running;
            }
        }
        let Some(stand_in) = stand_in else { return };
        for (lane, status) in self.status.iter().enumerate() {
            if *status == LaneStatus::Empty {
                for row in rows.chunks_exact_mut(lanes) {
                    row[lane] = row[stand_in];
                }
            }
        }
    }

    /// Returns the number of steps of the next block, at most `most`. No member has a stop before the end of the block.
    pub(crate) fn steps(&self, most: u64, host: &dyn Host<T, S>) -> u64 {
        let most = if self.replaying { 1 } else { most };
        let left = self.running().map(|run| run.stop.saturating_sub(run.made));
        let most = left.fold(most, u64::min);
        match self.has_more && self.status.contains(&LaneStatus::Empty) {
            // The block ends at a step at which empty lanes may be refilled.
            true => {
                let interval = self.interval();
                let ahead = interval + host.phase() % interval - self.phase();
                most.min((ahead - 1) % interval + 1)
            }
            false => most,
        }
    }

    /// Returns the running members.
    fn running(&self) -> impl Iterator<Item = &MemberRun<T, S>> {
        let occupied = self.runs.iter().zip(&self.status);
        occupied.filter_map(|(run, status)| run.as_ref().filter(|_| *status == LaneStatus::Running))
    }

    /// Adds `n` to the number of steps of the running members.
    pub(crate) fn made(&mut self, n: u64) {
        for (run, status) in self.runs.iter_mut().zip(&self.status) {
            if let Some(run) = run.as_mut().filter(|_| *status == LaneStatus::Running) {
                run.made += n;
            }
        }
    }

    /// Returns the running members whose drifts are followed.
    fn followed(&self) -> impl Iterator<Item = &MemberRun<T, S>> {
        let any = self
            .any_followed
            .then(|| self.running())
            .into_iter()
            .flatten();
        any.filter(|run| !run.followed.drifts.is_empty())
    }

    /// Returns the steps between two recorded states of the first member whose drift is followed; 1 if there is none.
    fn interval(&self) -> u64 {
        let followed = self.followed().next();
        followed.map_or(1, |run| run.interval.max(1))
    }

    /// Returns the steps of this member since its last recorded state.
    fn phase(&self) -> u64 {
        let followed = self.followed().next();
        followed.map_or(0, |run| run.made % run.interval.max(1))
    }

    /// Returns the steps after which the observers of the lanes receive states.
    pub(crate) fn schedule(&self) -> Schedule {
        let (interval, first) = (self.interval(), self.interval() - self.phase());
        let ahead = |run: &MemberRun<T, S>| {
            let interval = run.interval.max(1);
            [interval - run.made % interval, interval]
        };
        // Signs are compared after every step.
        let has_sections =
            self.any_followed && self.running().any(|run| !run.followed.sections.is_empty());
        let is_due = !has_sections || (first, interval) == (1, 1);
        if is_due && self.followed().all(|run| ahead(run) == [first, interval]) {
            return Schedule {
                first,
                interval,
                by_lane: None,
            };
        }
        let mut lanes = [(); 2].map(|()| alloc::vec![0; self.status.len()]);
        let mut common = u64::from(has_sections);
        for (lane, (run, status)) in self.runs.iter().zip(&self.status).enumerate() {
            let Some(run) = run.as_ref().filter(|_| *status == LaneStatus::Running) else {
                continue;
            };
            if run.followed.drifts.is_empty() || run.interval >= NEVER {
                continue;
            }
            for (lanes, steps) in lanes.iter_mut().zip(ahead(run)) {
                lanes[lane] = steps;
                common = divisor(steps, common);
            }
        }
        let common = common.max(1);
        Schedule {
            first: common,
            interval: common,
            by_lane: Some(lanes),
        }
    }

    /// Records that drifts without a first state have received it.
    pub(crate) fn begin_drifts(&mut self) {
        for run in self.runs.iter_mut().flatten() {
            for track in &mut run.followed.drifts {
                track.drift.get_or_insert_with(|| Deviation {
                    count: 1,
                    ..Deviation::new(T::zero())
                });
            }
        }
    }

    /// Writes the numbers of drift `k` of each lane into the runs, and adds the number of states since the last time.
    pub(crate) fn write_drift(&mut self, k: usize, lanes: &[Vec<T>; 4]) {
        for (lane, (run, status)) in self.runs.iter_mut().zip(&self.status).enumerate() {
            let Some(run) = run.as_mut().filter(|_| *status == LaneStatus::Running) else {
                continue;
            };
            let Some(Some(drift)) = run.followed.drifts.get_mut(k).map(|track| &mut track.drift)
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
            let interval = run.interval.max(1);
            drift.count += run.made / interval - run.since / interval;
        }
    }

    /// Records that the drifts are up to date.
    pub(crate) fn drifts_written(&mut self) {
        for run in self.runs.iter_mut().flatten() {
            run.since = run.made;
        }
    }

    /// Removes a member from its lane. Returns it, and true if it was being replayed.
    pub(crate) fn take(&mut self, lane: usize) -> Option<(MemberRun<T, S>, bool)> {
        if core::mem::replace(&mut self.status[lane], LaneStatus::Empty) == LaneStatus::Empty {
            return None;
        }
        self.change.get_or_insert_default();
        Some((self.runs[lane].take()?, self.replaying))
    }

    /// Adds a member that will be replayed.
    pub(crate) fn add_pending(&mut self, mut run: MemberRun<T, S>) {
        run.system_changed = true;
        self.pending.push(run);
    }

    /// Returns true for each lane whose member is inside the domain of H, or which has none. The rows have the states,
    /// component by component.
    pub(crate) fn inside(&self, rows: &[T]) -> Vec<bool> {
        let members = self.runs.iter().zip(&self.status).map(|(run, status)| {
            let run = run.as_ref().filter(|_| *status == LaneStatus::Running)?;
            Some((&run.prepared, &run.state))
        });
        inside::<T, S>(members, rows, self.status.len())
    }

    /// Returns true if any running member is at its stop.
    pub(crate) fn is_any_due(&self) -> bool {
        self.running().any(|run| run.made == run.stop)
    }

    /// Calls a function with each member at its stop. The function returns true if the member stays.
    pub(crate) fn for_each_due(&mut self, mut of: impl FnMut(usize, &mut MemberRun<T, S>) -> bool) {
        for (lane, (run, status)) in self.runs.iter_mut().zip(&mut self.status).enumerate() {
            let running = run.as_mut().filter(|_| *status == LaneStatus::Running);
            if let Some(run) = running.filter(|run| run.made == run.stop)
                && !of(lane, run)
            {
                *status = LaneStatus::Leaving;
            }
        }
    }

    /// Returns true if any member whose observer follows signs is at its stop after `n` more steps.
    pub(crate) fn is_any_due_with_sections(&self, n: u64) -> bool {
        let mut due = self.running().filter(|run| run.made + n == run.stop);
        due.any(|run| !run.followed.sections.is_empty())
    }

    /// Calls a function with each running member whose lane is one of `which` and whose observer follows signs. The
    /// function returns true if the member stays.
    pub(crate) fn for_each_with_sections(
        &mut self,
        which: impl Fn(usize) -> bool,
        mut of: impl FnMut(usize, &mut MemberRun<T, S>) -> bool,
    ) {
        let lanes = self.runs.iter_mut().zip(&mut self.status).enumerate();
        for (lane, (run, status)) in lanes.filter(|(lane, _)| which(*lane)) {
            let running = run.as_mut().filter(|_| *status == LaneStatus::Running);
            if let Some(run) = running.filter(|run| !run.followed.sections.is_empty())
                && !of(lane, run)
            {
                *status = LaneStatus::Leaving;
            }
        }
    }

    /// Records that the followed quantities of a member have changed.
    pub(crate) fn followed_changed(&mut self) {
        self.any_followed = true;
        self.change.get_or_insert_default();
    }

    /// Loads the carried values of the running members that were changed at the current step.
    pub(crate) fn reload(&mut self) {
        for (run, status) in self.runs.iter().zip(&mut self.status) {
            let is_moved = |run: &MemberRun<T, S>| run.began == run.made;
            if *status == LaneStatus::Running && run.as_ref().is_some_and(is_moved) {
                *status = LaneStatus::Loaded;
            }
        }
        self.change.get_or_insert_default();
    }

    /// Returns true if any member leaves.
    pub(crate) fn is_any_leaving(&self) -> bool {
        self.status.contains(&LaneStatus::Leaving)
    }

    /// Returns leaving members to the host, with their carried values, and empties their lanes.
    pub(crate) fn leave(&mut self, rows: &[T], host: &mut dyn Host<T, S>) {
        let lanes = self.status.len();
        for (lane, (run, status)) in self.runs.iter_mut().zip(&mut self.status).enumerate() {
            if *status != LaneStatus::Leaving {
                continue;
            }
            *status = LaneStatus::Empty;
            self.change.get_or_insert_default();
            let Some(run) = run else { continue };
            for (row, word) in rows.chunks_exact(lanes).zip(&mut run.words) {
                *word = row[lane];
            }
            host.leave(run);
        }
    }
}
