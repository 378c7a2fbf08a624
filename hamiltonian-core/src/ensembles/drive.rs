//! Integration of members to their ends, in the lanes of one pack type.
//!
//! Input: a scheme and a host. Output: the host has received every member at each of its stops. Invariants:
//! a member's bits depend only on its own run and on the arithmetic of the pack. Lanes are refilled only between
//! blocks. A member that fails does not delay the others, since it is replayed after them.

pub(super) mod deviations;
mod scalar;
mod sections;
mod transfer;

use self::scalar::{explain, pass_to_host};
use self::transfer::{Begin, Prepare, gather, lanes_of, load, scatter, store};
use super::block::{Block, Followed, LaneClock, LaneSchedule, Opening};
use super::close::{Close, WriteRows};
use super::host::{Host, MemberRun};
use super::marks::{LastThree, Marks};
use super::occupants::Occupants;
use crate::flows::map::{Clock, Map};
use crate::observers::observe::{LaneDrift, LaneSection, MemberSection, Quantity};
use crate::schemes::scheme::{CarriedBy, Scheme};
use crate::systems::flow::Scratch;
use crate::systems::state::Carried;
use crate::systems::system::{Dynamics, System};
use crate::systems::vector::Vector;
use alloc::vec;
use alloc::vec::Vec;
use hamiltonian_lanes::{Level, Mask, Pack, Real};

/// The number of steps between two checks that all numbers are finite, as in a single run.
const BLOCK: u64 = 1024;

/// The map of a scheme over the lanes of `P`.
pub(super) type MapIn<T, S, P, M> = <M as Scheme<S>>::Map<<T as Real>::Over<P>>;
/// The value that such a map carries.
pub(super) type CarriedIn<T, S, P, M> = CarriedBy<M, S, <T as Real>::Over<P>>;
/// The lane mask of the scalar.
type MaskIn<T, P> = <<T as Real>::Over<P> as Real>::Mask;

/// Drives all members of the host to their ends, inside the level `L` of the pack.
#[cfg_attr(not(unoptimised), inline(always))]
pub(super) fn drive<L: Level, T: Real, S: System, P: Pack, M: Scheme<S>>(
    scheme: &M,
    host: &mut dyn Host<T, S>,
) {
    let mut occupants = Occupants::<T, S>::new(P::LANES as usize);
    if !occupants.fill(host) {
        return;
    }
    let mut lanes = Lanes::<T, S, P, M>::new::<L>(scheme, &occupants);
    while !host.is_cancelled() {
        lanes.load_lanes::<L>(scheme, &mut occupants);
        // The first value of a drift is that at the start, so a block without steps evaluates it.
        let attach = lanes.attach.take();
        let n = match attach {
            Some(_) => 0,
            None => occupants.steps(BLOCK, host),
        };
        lanes.before.copy_from(&lanes.carried);
        lanes.drifts_before.copy_from_slice(&lanes.drifts);
        let has_sections = !lanes.sections.is_empty();
        if has_sections {
            lanes.sections_before.copy_from_slice(&lanes.sections);
            lanes.marks.copy_last(&mut lanes.last_three);
            lanes.marks.steps.clear();
        }
        let schedule = occupants.schedule();
        let closes = lanes.closes();
        let energy = lanes.quantities().any(|one| one == Quantity::Energy);
        if let Some([left, interval]) = &schedule.by_lane {
            gather::<L, T, P>(&as_scalars(left), &mut lanes.schedule.left);
            gather::<L, T, P>(&as_scalars(interval), &mut lanes.schedule.interval);
        }
        let followed: Followed<'_, T::Over<P>, S> = Followed {
            prepared: &lanes.prepared,
            drifts: &mut lanes.drifts,
            sections: &mut lanes.sections,
            section_lanes: lanes.section_lanes,
            energy,
            closes,
            first: schedule.first,
            interval: schedule.interval,
            by_lane: schedule.by_lane.map(|_| &mut lanes.schedule),
            attach,
        };
        let (mut finite, end) = L::enter(Block {
            map: &lanes.map,
            times: &lanes.times,
            made: lanes.made,
            n,
            opening: lanes.opening,
            carried: &mut lanes.carried,
            shown: &mut lanes.shown,
            spare: &mut lanes.passed,
            work: &mut lanes.work,
            followed,
            marks: &mut lanes.marks,
        });
        if !closes && end < lanes.made + n {
            (_, finite) = L::enter(Close::<'_, _, T, P> {
                map: &lanes.map,
                times: &lanes.times,
                made: end,
                carried: &lanes.carried,
                shown: &mut lanes.shown,
                rows: &mut lanes.passed_rows,
            });
        }
        let n = end - lanes.made;
        let numbers = finite;
        if n > 0 {
            lanes.opening = Opening::Join;
            finite = finite & lanes.inside::<L>(end, &occupants);
        }
        if attach.is_some() {
            occupants.begin_drifts();
        }
        if !finite.all() {
            lanes.remove_failed::<L>(scheme, [numbers, finite], &mut occupants, host);
        }
        if has_sections {
            lanes.pass_marked::<L>(scheme, n, &mut occupants, host);
        }
        occupants.made(n);
        lanes.made += n;
        lanes.pass_due::<L>(scheme, &mut occupants, host);
        if !occupants.fill(host) {
            return;
        }
    }
}

/// The occupants in lanes, with the map of their steps and the followed quantities.
struct Lanes<T, S, P, M>
where
    T: Real,
    P: Pack,
    S: System,
    M: Scheme<S>,
{
    prepared: S::Prepared<T::Over<P>>,
    map: MapIn<T, S, P, M>,
    work: <MapIn<T, S, P, M> as Map>::Work,
    carried: CarriedIn<T, S, P, M>,
    /// The carried value at the beginning of the block.
    before: CarriedIn<T, S, P, M>,
    /// The closed state.
    shown: CarriedIn<T, S, P, M>,
    times: LaneClock<T::Over<P>>,
    opening: Opening<MaskIn<T, P>>,
    /// Steps since the occupants last changed.
    made: u64,
    /// The drifts that are followed, and the same at the beginning of the block.
    drifts: Vec<LaneDrift<T::Over<P>>>,
    drifts_before: Vec<LaneDrift<T::Over<P>>>,
    /// The functions whose sign is followed, with their values, and the same at the beginning of the block.
    sections: Vec<LaneSection<T::Over<P>>>,
    sections_before: Vec<LaneSection<T::Over<P>>>,
    /// The same functions over the members' scalar.
    member_sections: Vec<MemberSection<T>>,
    /// The lanes whose observers follow signs.
    section_lanes: MaskIn<T, P>,
    marks: Marks<CarriedIn<T, S, P, M>, MaskIn<T, P>>,
    /// The carried values after the three steps before the block.
    last_three: LastThree<CarriedIn<T, S, P, M>>,
    /// Scratch for the states that observers of signs receive between stops.
    passed: CarriedIn<T, S, P, M>,
    passed_rows: Vec<T>,
    /// The lanes whose drift begins at their current state.
    attach: Option<MaskIn<T, P>>,
    /// The steps after which the observers of lanes receive states, if the lanes differ.
    schedule: LaneSchedule<T::Over<P>>,
    /// True if the map was prepared for the current occupants before they were loaded into the lanes.
    is_prepared: bool,
    /// The step of each lane for which the map was prepared.
    steps: Vec<T>,
    /// True if all lanes have the same parameters.
    uniform: bool,
    /// Scratch for a number of each lane.
    numbers: Vec<T>,
    /// Scratch for numbers of the lanes, component by component.
    rows: Vec<T>,
}

impl<T, S, P, M> Lanes<T, S, P, M>
where
    T: Real,
    P: Pack,
    S: System,
    M: Scheme<S>,
{
    /// Allocates lanes in the shape of the first occupants, which are loaded afterwards.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn new<L: Level>(scheme: &M, occupants: &Occupants<T, S>) -> Self {
        let runs = occupants.runs();
        let steps = number_of_each(&runs, |run| run.step);
        let systems: Vec<_> = runs.iter().map(|run| &run.prepared).collect();
        let (prepared, map) = L::enter(Prepare::<T, S, P, M>::new(scheme, &systems, &steps));
        let begin = Begin::<T, S, P, M>::new(scheme, &prepared, &runs[0].state, &steps);
        let carried = L::enter(begin);
        let mut lanes = Lanes {
            map,
            work: Scratch::like(&carried),
            before: cloned(&carried),
            marks: Marks::new([cloned(&carried), cloned(&carried), cloned(&carried)]),
            last_three: [cloned(&carried), cloned(&carried), cloned(&carried)],
            sections: Vec::new(),
            sections_before: Vec::new(),
            member_sections: Vec::new(),
            passed: cloned(&carried),
            passed_rows: Vec::new(),
            section_lanes: Mask::splat(false),
            shown: cloned(&carried),
            rows: vec![T::default(); carried.len() * P::LANES as usize],
            numbers: Vec::with_capacity(runs.len()),
            carried,
            times: LaneClock::default(),
            opening: Opening::Open,
            prepared,
            drifts: Vec::new(),
            drifts_before: Vec::new(),
            attach: None,
            schedule: LaneSchedule::default(),
            made: 0,
            steps,
            uniform: false,
            is_prepared: true,
        };
        lanes.compare(&runs);
        lanes
    }

    /// Sets `uniform` by comparing the parameters of all runs.
    fn compare(&mut self, runs: &[&MemberRun<T, S>]) {
        let mut pairs = runs.windows(2);
        self.uniform = pairs.all(|pair| S::equals(&pair[0].prepared, &pair[1].prepared));
    }

    /// Loads occupants that have changed into the lanes.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn load_lanes<L: Level>(&mut self, scheme: &M, occupants: &mut Occupants<T, S>) {
        let Some(changed) = occupants.changed() else {
            return;
        };
        self.write_sections::<L>(&self.sections, occupants);
        store::<L, T, P, _>(&self.carried, &mut self.rows);
        occupants.write_columns(&mut self.rows);
        let runs = occupants.runs();
        let steps = runs.iter().map(|run| run.step);
        let others = changed.parameters || !self.uniform;
        let is_prepared = core::mem::take(&mut self.is_prepared);
        if !is_prepared && (others || !steps.clone().eq(self.steps.iter().copied())) {
            let steps: Vec<T> = steps.collect();
            let systems: Vec<_> = runs.iter().map(|run| &run.prepared).collect();
            (self.prepared, self.map) =
                L::enter(Prepare::<T, S, P, M>::new(scheme, &systems, &steps));
            self.steps = steps;
            self.compare(&runs);
        }
        load::<L, T, P, _>(&self.rows, &mut self.carried);
        self.load_drifts::<L>(&runs);
        self.load_sections::<L>(&runs);
        self.marks.replace(&self.carried);
        self.made = 0;
        let LaneClock {
            start,
            interval,
            ahead,
        } = &mut self.times;
        for (at, into) in [start, interval, ahead].into_iter().enumerate() {
            self.numbers.clear();
            let number = |run: &&MemberRun<T, S>| {
                let Clock {
                    start, interval, ..
                } = run.clock;
                [start, interval, as_scalar(run.made)][at]
            };
            self.numbers.extend(runs.iter().map(number));
            gather::<L, T, P>(&self.numbers, into);
        }
        self.opening = match (changed.any_at_start, changed.all_at_start) {
            (_, true) => Opening::Open,
            (false, _) => Opening::Join,
            _ => {
                let at_start: Vec<bool> = runs.iter().map(|run| run.made == run.began).collect();
                Opening::Mixed(lanes_of::<L, T, P>(&at_start))
            }
        };
    }

    /// Returns the quantities that are followed.
    fn quantities(&self) -> impl Iterator<Item = Quantity> {
        let drifts = self.drifts.iter().map(|drift| drift.quantity);
        let sections = self.sections.iter().map(|section| section.observable);
        let sections = sections.map(Quantity::Observable);
        drifts.chain(sections)
    }

    /// Returns true if any followed quantity depends on what the closing piece of a step changes.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn closes(&self) -> bool {
        let closing = self.map.closing();
        let system = self.prepared.description();
        self.quantities().any(|quantity| {
            let reads = quantity.reads(system);
            (0..2).any(|half| closing[half] && reads[half])
        })
    }

    /// Loads the drifts of the members into lanes.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn load_drifts<L: Level>(&mut self, runs: &[&MemberRun<T, S>]) {
        // The first followed member determines the quantities; members that differ receive states at their stops.
        let first = runs.iter().find(|run| !run.followed.drifts.is_empty());
        let drifts = first.map_or(&[][..], |run| &run.followed.drifts);
        for lane_drifts in [&mut self.drifts, &mut self.drifts_before] {
            lane_drifts.truncate(drifts.len());
        }
        if drifts.is_empty() {
            return;
        }
        let mut begins = vec![false; runs.len()];
        for (k, track) in drifts.iter().enumerate() {
            let mut lanes = [(); 4].map(|()| vec![T::zero(); runs.len()]);
            for (lane, run) in runs.iter().enumerate() {
                let Some(track) = run.followed.drifts.get(k) else {
                    continue;
                };
                let Some(drift) = &track.drift else {
                    begins[lane] = true;
                    continue;
                };
                let number = |number| T::constant(number, 0.0);
                lanes[0][lane] = drift.start;
                lanes[1][lane] = number(drift.max);
                lanes[2][lane] = number(drift.sum_of_sizes);
                lanes[3][lane] = number(drift.sum);
            }
            if k == self.drifts.len() {
                self.drifts.push(LaneDrift::new(track.quantity));
                self.drifts_before.push(LaneDrift::new(track.quantity));
            }
            let lane_drift = &mut self.drifts[k];
            lane_drift.quantity = track.quantity;
            for (numbers, into) in lanes.iter().zip(lane_drift.numbers_mut()) {
                gather::<L, T, P>(numbers, into);
            }
        }
        if begins.contains(&true) {
            self.attach = Some(lanes_of::<L, T, P>(&begins));
        }
    }

    /// Writes drifts back into the runs of some lanes.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn write_drifts<L: Level>(drifts: &[LaneDrift<T::Over<P>>], occupants: &mut Occupants<T, S>) {
        let mut lanes = [(); 4].map(|()| vec![T::zero(); P::LANES as usize]);
        for (k, lane_drift) in drifts.iter().enumerate() {
            for (lanes, pack) in lanes.iter_mut().zip(lane_drift.numbers()) {
                scatter::<L, T, P>(pack, lanes);
            }
            occupants.write_drift(k, &lanes);
        }
        occupants.drifts_written();
    }

    /// Returns the lanes whose members are inside the domain of H after a block of steps, and were so at each state at
    /// which the block evaluated H.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn inside<L: Level>(&mut self, made: u64, occupants: &Occupants<T, S>) -> MaskIn<T, P> {
        L::enter(WriteRows::<'_, _, T, P> {
            times: &self.times,
            made,
            carried: &self.carried,
            shown: &self.shown,
            rows: &mut self.passed_rows,
        });
        let inside = occupants.inside(&self.passed_rows);
        let mut lanes = match inside.contains(&false) {
            true => lanes_of::<L, T, P>(&inside),
            false => Mask::splat(true),
        };
        for drift in &self.drifts {
            if drift.quantity == Quantity::Energy {
                lanes = lanes & drift.numbers()[2].finite();
            }
        }
        lanes
    }

    /// Removes the members that are not finite after a block. They will be replayed step by step. A member that is
    /// being replayed is passed to the host with its error. In the lanes of `numbers`, only H is not finite.
    #[cold]
    #[inline(never)]
    fn remove_failed<L: Level>(
        &mut self,
        scheme: &M,
        [numbers, finite]: [MaskIn<T, P>; 2],
        occupants: &mut Occupants<T, S>,
        host: &mut dyn Host<T, S>,
    ) {
        let lanes = P::LANES as usize;
        let mut before = vec![T::default(); self.rows.len()];
        store::<L, T, P, _>(&self.before, &mut before);
        let (mut shown, size) = (Vec::new(), self.shown.point().q.len());
        L::enter(WriteRows::<'_, _, T, P> {
            times: &self.times,
            made: self.made + 1,
            carried: &self.carried,
            shown: &self.shown,
            rows: &mut shown,
        });
        store::<L, T, P, _>(&self.carried, &mut self.rows);
        Self::write_drifts::<L>(&self.drifts_before, occupants);
        let bad: Vec<bool> = (0..P::LANES).map(|lane| !finite.lane(lane)).collect();
        if !self.sections.is_empty() {
            self.write_sections::<L>(&self.sections_before, occupants);
            self.pass_states::<L>(scheme, self.made, (true, &bad), occupants, host);
        }
        let bad = (0..lanes).filter(|lane| bad[*lane]);
        for lane in bad {
            let column = |rows: &[T], c: usize| rows[c * lanes + lane];
            let Some((mut run, replaying)) = occupants.take(lane) else {
                continue;
            };
            for (c, word) in run.words.iter_mut().enumerate() {
                *word = column(&before, c);
            }
            if !replaying {
                occupants.add_pending(run);
                continue;
            }
            let point: Vec<f64> = (0..2 * size).map(|c| column(&shown, c).to_f64()).collect();
            let single = (&run.prepared, &run.state, run.step, run.clock);
            let made = (run.made, run.made == run.began, &*run.words);
            let reached = column(&shown, 2 * size).to_f64();
            let only_energy = numbers.lane(lane as u32);
            let error = explain(scheme, single, made, (&point, reached), only_energy);
            host.fail(&mut run, error);
        }
    }

    /// Passes members at their stops to the host, which takes back those that leave.
    #[cfg_attr(not(unoptimised), inline(always))]
    fn pass_due<L: Level>(
        &mut self,
        scheme: &M,
        occupants: &mut Occupants<T, S>,
        host: &mut dyn Host<T, S>,
    ) {
        let lanes = P::LANES as usize;
        let is_any_due = occupants.is_any_due();
        if !self.drifts.is_empty() && (is_any_due || occupants.has_changed()) {
            Self::write_drifts::<L>(&self.drifts, occupants);
        }
        if !is_any_due {
            return;
        }
        if !self.drifts.is_empty() {
            occupants.for_each_due(|_, run| {
                if !run.followed.drifts.is_empty() {
                    host.take_drifts(run.key, run.prepared.description(), &mut run.followed);
                }
                true
            });
        }
        if host.observes() {
            let size = self.shown.point().q.len();
            let carries_duration = L::enter(WriteRows::<'_, _, T, P> {
                times: &self.times,
                made: self.made,
                carried: &self.carried,
                shown: &self.shown,
                rows: &mut self.passed_rows,
            });
            let mut rows = self.passed_rows.chunks_exact(lanes);
            for (c, row) in (0..size).zip(&mut rows) {
                occupants.write_states(row, |state| state.q.component_mut(c));
            }
            for (c, row) in (0..size).zip(&mut rows) {
                occupants.write_states(row, |state| state.p.component_mut(c));
            }
            for row in rows.by_ref().take(1) {
                occupants.write_states(row, |state| &mut state.t);
            }
            let durations = rows.next().filter(|_| carries_duration);
            let has_parts = self.map.has_parts();
            if has_parts {
                store::<L, T, P, _>(&self.carried, &mut self.rows);
            }
            let words = has_parts.then_some(&*self.rows);
            pass_to_host(scheme, occupants, host, durations, words);
        } else {
            occupants.for_each_due(|_, _| false);
        }
        if occupants.is_any_leaving() {
            store::<L, T, P, _>(&self.carried, &mut self.rows);
            occupants.leave(&self.rows, host);
        }
    }
}

/// Returns a number of each run.
fn number_of_each<T: Real, S: System>(
    runs: &[&MemberRun<T, S>],
    of: impl Fn(&MemberRun<T, S>) -> T,
) -> Vec<T> {
    runs.iter().map(|run| of(run)).collect()
}

/// Returns a number of steps as a scalar.
fn as_scalar<T: Real>(steps: u64) -> T {
    T::constant(steps as i64 as f64, 0.0)
}

/// Returns numbers of steps as scalars.
fn as_scalars<T: Real>(steps: &[u64]) -> Vec<T> {
    steps.iter().map(|n| as_scalar(*n)).collect()
}

/// Returns a copy. The function is not inlined, since values in lanes are long and are copied in many places.
#[inline(never)]
fn cloned<C: Clone>(of: &C) -> C {
    of.clone()
}
