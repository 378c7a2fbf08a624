//! Members driven to their ends in the lanes of one pack type.
//!
//! Input: a scheme and a host. Output: the host has received every member at each of its stops. Invariants:
//! a member's bits depend on its seat and on the arithmetic of the pack alone. Lanes are refilled at the ends
//! of blocks only. A failure costs the other members nothing, since the failed one is replayed apart from
//! them.

mod alone;
pub(super) mod deviations;
mod rows;
mod watching;

use self::alone::{arrivals, explain};
use self::deviations::Deviations;
use self::rows::{Begin, Prepare, gather, lanes_of, load, scatter, store};
use super::block::{Apart, Block, Followed, Opening, Times};
use super::close::{Close, Show};
use super::crew::Crew;
use super::marks::{Marks, Three};
use super::seat::{Host, Seat};
use crate::flow::Scratch;
use crate::map::{Clock, Map};
use crate::observe::{Quantity, Section, Tracker, Watcher};
use crate::scheme::Scheme;
use crate::state::Carried;
use crate::system::System;
use crate::system::gather::{Gather, VectorOver};
use crate::vector::Vector;
use alloc::vec;
use alloc::vec::Vec;
use hamiltonian_lanes::{Level, Mask, Pack, Real};

/// The number of steps between two checks that all numbers are finite, as in a single run.
const BLOCK: u64 = 1024;

/// A scheme that drives members of `S` in the lanes of `P`.
pub trait InPack<T: Real, S: System<T>, P: Pack>: Scheme<T, S> {
    /// Drives all members of the host to their ends, inside the level `L` of the pack.
    fn drive<L: Level>(&self, host: &mut dyn Host<T, S>);
    /// Advances members with deviations to their ends, likewise.
    fn deviate<L: Level>(&self, all: &mut Deviations<'_, T, S>);
}

/// The map of a scheme over the lanes of `P`.
pub(super) type MapIn<T, S, P, M> = <M as Scheme<<T as Real>::Over<P>, S>>::Map;
/// The value that such a map carries.
pub(super) type CarriedIn<T, S, P, M> = <MapIn<T, S, P, M> as Map>::Carried;
/// The lane mask of the scalar.
type MaskIn<T, P> = <<T as Real>::Over<P> as Real>::Mask;

impl<T, S, P, M> InPack<T, S, P> for M
where
    T: Real,
    P: Pack,
    S: System<T, Prepared: Gather<T>>
        + System<
            T::Over<P>,
            Vector = VectorOver<<S as System<T>>::Vector, P>,
            Prepared = <<S as System<T>>::Prepared as Gather<T>>::Over<T::Over<P>>,
        >,
    M: Scheme<T, S> + Scheme<T::Over<P>, S>,
{
    #[inline(always)]
    fn deviate<L: Level>(&self, all: &mut Deviations<'_, T, S>) {
        deviations::advance::<L, T, S, P, M>(self, all);
    }

    #[inline(always)]
    fn drive<L: Level>(&self, host: &mut dyn Host<T, S>) {
        let mut crew = Crew::<T, S>::new(P::LANES as usize);
        if !crew.fill(host) {
            return;
        }
        let mut lanes = Lanes::<T, S, P, M>::new::<L>(self, &crew);
        while !host.is_cancelled() {
            lanes.board::<L>(self, &mut crew);
            // A drift begins at the start: its first state is evaluated before the first step.
            let attach = lanes.attach.take();
            let n = match attach {
                Some(_) => 0,
                None => crew.steps(BLOCK, host),
            };
            lanes.before.copy_from(&lanes.carried);
            lanes.trackers_before.copy_from_slice(&lanes.trackers);
            let watches = !lanes.watchers.is_empty();
            if watches {
                lanes.watchers_before.copy_from_slice(&lanes.watchers);
                lanes.marks.last(&mut lanes.three);
                lanes.marks.steps.clear();
            }
            let schedule = crew.schedule();
            let closes = lanes.closes();
            let energy = lanes.quantities().any(|one| one == Quantity::Energy);
            if let Some([left, interval]) = &schedule.apart {
                gather::<L, T, P>(&counts(left), &mut lanes.apart.left);
                gather::<L, T, P>(&counts(interval), &mut lanes.apart.interval);
            }
            let followed: Followed<'_, T::Over<P>, S> = Followed {
                prepared: &lanes.prepared,
                trackers: &mut lanes.trackers,
                watchers: &mut lanes.watchers,
                watched: lanes.watched,
                energy,
                closes,
                first: schedule.first,
                interval: schedule.interval,
                apart: schedule.apart.map(|_| &mut lanes.apart),
                attach,
            };
            let (mut finite, end) = L::enter_at(Block {
                map: &lanes.map,
                times: &lanes.times,
                made: lanes.made,
                n,
                opening: lanes.opening,
                carried: &mut lanes.carried,
                shown: &mut lanes.shown,
                spare: &mut lanes.passing,
                work: &mut lanes.work,
                followed,
                marks: &mut lanes.marks,
            });
            if !closes && end < lanes.made + n {
                (_, finite) = L::enter_at(Close::<'_, _, T, P> {
                    map: &lanes.map,
                    times: &lanes.times,
                    made: end,
                    carried: &lanes.carried,
                    shown: &mut lanes.shown,
                    rows: &mut lanes.passing_rows,
                });
            }
            let n = end - lanes.made;
            if n > 0 {
                lanes.opening = Opening::Join;
            }
            if attach.is_some() {
                crew.attached();
            }
            if !finite.all() {
                lanes.part_with::<L>(self, finite, &mut crew, host);
            }
            if watches {
                lanes.show_marks::<L>(self, n, &mut crew, host);
            }
            crew.made(n);
            lanes.made += n;
            lanes.arrive::<L>(self, &mut crew, host);
            if !crew.fill(host) {
                return;
            }
        }
    }
}

/// The members of a crew in lanes, with the map of their steps and the followed quantities.
struct Lanes<T, S, P, M>
where
    T: Real,
    P: Pack,
    S: System<T> + System<T::Over<P>>,
    M: Scheme<T::Over<P>, S>,
{
    prepared: <S as System<T::Over<P>>>::Prepared,
    map: MapIn<T, S, P, M>,
    work: <MapIn<T, S, P, M> as Map>::Work,
    carried: CarriedIn<T, S, P, M>,
    /// The carried value at the beginning of the block.
    before: CarriedIn<T, S, P, M>,
    /// The closed state.
    shown: CarriedIn<T, S, P, M>,
    times: Times<T::Over<P>>,
    opening: Opening<MaskIn<T, P>>,
    /// Steps since the crew last changed.
    made: u64,
    /// The drifts that are followed, and those at the beginning of the block.
    trackers: Vec<Tracker<T::Over<P>>>,
    trackers_before: Vec<Tracker<T::Over<P>>>,
    /// The functions whose sign is followed, and those at the beginning of the block.
    watchers: Vec<Watcher<T::Over<P>>>,
    watchers_before: Vec<Watcher<T::Over<P>>>,
    /// The same functions over the members' scalar.
    functions: Vec<Section<T>>,
    /// The lanes whose observers follow signs.
    watched: MaskIn<T, P>,
    marks: Marks<CarriedIn<T, S, P, M>, MaskIn<T, P>>,
    /// The carried values after the three steps before the block.
    three: Three<CarriedIn<T, S, P, M>>,
    /// Scratch for the states that observers of signs receive between stops.
    passing: CarriedIn<T, S, P, M>,
    passing_rows: Vec<T>,
    /// The lanes whose drift begins at their present state.
    attach: Option<MaskIn<T, P>>,
    /// The steps after which the observers of lanes receive states, if the lanes differ.
    apart: Apart<T::Over<P>>,
    /// True if the map is that of a crew which is not yet loaded into the lanes.
    is_prepared: bool,
    /// The step of each lane for which the map is made.
    steps: Vec<T>,
    /// True if all lanes have the same parameters.
    uniform: bool,
    /// A number of each lane.
    numbers: Vec<T>,
    /// Numbers of the lanes, component by component.
    rows: Vec<T>,
}

impl<T, S, P, M> Lanes<T, S, P, M>
where
    T: Real,
    P: Pack,
    S: System<T, Prepared: Gather<T>>
        + System<
            T::Over<P>,
            Vector = VectorOver<<S as System<T>>::Vector, P>,
            Prepared = <<S as System<T>>::Prepared as Gather<T>>::Over<T::Over<P>>,
        >,
    M: Scheme<T, S> + Scheme<T::Over<P>, S>,
{
    /// Allocates lanes of the shapes of the first crew, which is loaded afterwards.
    #[inline(always)]
    fn new<L: Level>(scheme: &M, crew: &Crew<T, S>) -> Self {
        let seats = crew.seats();
        let steps = each(&seats, |seat| seat.step);
        let systems: Vec<_> = seats.iter().map(|seat| &seat.prepared).collect();
        let (prepared, map) = L::enter_at(Prepare::<T, S, P, M>::new(scheme, &systems, &steps));
        let begin = Begin::<T, S, P, M>::new(scheme, &prepared, &seats[0].state, &steps);
        let carried = L::enter_at(begin);
        let mut lanes = Lanes {
            map,
            work: Scratch::like(&carried),
            before: another(&carried),
            marks: Marks::new([another(&carried), another(&carried), another(&carried)]),
            three: [another(&carried), another(&carried), another(&carried)],
            watchers: Vec::new(),
            watchers_before: Vec::new(),
            functions: Vec::new(),
            passing: another(&carried),
            passing_rows: Vec::new(),
            watched: Mask::splat(false),
            shown: another(&carried),
            rows: vec![T::default(); carried.len() * P::LANES as usize],
            numbers: Vec::with_capacity(seats.len()),
            carried,
            times: Times::default(),
            opening: Opening::Open,
            prepared,
            trackers: Vec::new(),
            trackers_before: Vec::new(),
            attach: None,
            apart: Apart::default(),
            made: 0,
            steps,
            uniform: false,
            is_prepared: true,
        };
        lanes.compare(&seats);
        lanes
    }

    /// Compares the parameters of all seats.
    fn compare(&mut self, seats: &[&Seat<T, S>]) {
        let mut pairs = seats.windows(2);
        self.uniform = pairs.all(|pair| pair[0].prepared.equals(&pair[1].prepared));
    }

    /// Loads a crew that has changed into the lanes.
    #[inline(always)]
    fn board<L: Level>(&mut self, scheme: &M, crew: &mut Crew<T, S>) {
        let Some(changed) = crew.changed() else {
            return;
        };
        self.write_sections::<L>(&self.watchers, crew);
        store::<L, T, P, _>(&self.carried, &mut self.rows);
        crew.write_columns(&mut self.rows);
        let seats = crew.seats();
        let steps = seats.iter().map(|seat| seat.step);
        let others = changed.parameters || !self.uniform;
        let is_prepared = core::mem::take(&mut self.is_prepared);
        if !is_prepared && (others || !steps.clone().eq(self.steps.iter().copied())) {
            let steps: Vec<T> = steps.collect();
            let systems: Vec<_> = seats.iter().map(|seat| &seat.prepared).collect();
            (self.prepared, self.map) =
                L::enter_at(Prepare::<T, S, P, M>::new(scheme, &systems, &steps));
            self.steps = steps;
            self.compare(&seats);
        }
        load::<L, T, P, _>(&self.rows, &mut self.carried);
        self.track::<L>(&seats);
        self.watch::<L>(&seats);
        self.marks.replace(&self.carried);
        self.made = 0;
        let Times {
            start,
            interval,
            ahead,
        } = &mut self.times;
        for (at, into) in [start, interval, ahead].into_iter().enumerate() {
            self.numbers.clear();
            let number = |seat: &&Seat<T, S>| {
                let Clock { start, interval } = seat.clock;
                [start, interval, count(seat.made)][at]
            };
            self.numbers.extend(seats.iter().map(number));
            gather::<L, T, P>(&self.numbers, into);
        }
        self.opening = match (changed.some_fresh, changed.all_fresh) {
            (_, true) => Opening::Open,
            (false, _) => Opening::Join,
            _ => {
                let fresh: Vec<bool> = seats.iter().map(|seat| seat.made == 0).collect();
                Opening::Mixed(lanes_of::<L, T, P>(&fresh))
            }
        };
    }

    /// The quantities that are followed.
    fn quantities(&self) -> impl Iterator<Item = Quantity> {
        let trackers = self.trackers.iter().map(|tracker| tracker.quantity);
        let watchers = self.watchers.iter().map(|watcher| watcher.observable);
        let watchers = watchers.map(Quantity::Observable);
        trackers.chain(watchers)
    }

    /// Returns true if any followed quantity depends on what the closing piece of a step changes.
    #[inline(always)]
    fn closes(&self) -> bool {
        let closing = self.map.closing();
        self.quantities().any(|quantity| {
            let reads = quantity.reads::<T, S>();
            (0..2).any(|half| closing[half] && reads[half])
        })
    }

    /// Loads the drifts of the members into lanes.
    #[inline(always)]
    fn track<L: Level>(&mut self, seats: &[&Seat<T, S>]) {
        // The first followed member determines the quantities; members that differ receive states at their stops.
        let first = seats.iter().find(|seat| !seat.follows.drifts.is_empty());
        let drifts = first.map_or(&[][..], |seat| &seat.follows.drifts);
        for trackers in [&mut self.trackers, &mut self.trackers_before] {
            trackers.truncate(drifts.len());
        }
        if drifts.is_empty() {
            return;
        }
        let mut begins = vec![false; seats.len()];
        for (k, track) in drifts.iter().enumerate() {
            let mut lanes = [(); 4].map(|()| vec![T::zero(); seats.len()]);
            for (lane, seat) in seats.iter().enumerate() {
                let Some(track) = seat.follows.drifts.get(k) else {
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
            if k == self.trackers.len() {
                self.trackers.push(Tracker::new(track.quantity));
                self.trackers_before.push(Tracker::new(track.quantity));
            }
            let tracker = &mut self.trackers[k];
            tracker.quantity = track.quantity;
            for (numbers, into) in lanes.iter().zip(tracker.numbers_mut()) {
                gather::<L, T, P>(numbers, into);
            }
        }
        if begins.contains(&true) {
            self.attach = Some(lanes_of::<L, T, P>(&begins));
        }
    }

    /// Writes drifts back into the seats of some lanes.
    #[inline(always)]
    fn write_tracks<L: Level>(trackers: &[Tracker<T::Over<P>>], crew: &mut Crew<T, S>) {
        let mut lanes = [(); 4].map(|()| vec![T::zero(); P::LANES as usize]);
        for (k, tracker) in trackers.iter().enumerate() {
            for (lanes, pack) in lanes.iter_mut().zip(tracker.numbers()) {
                scatter::<L, T, P>(pack, lanes);
            }
            crew.write_track(k, &lanes);
        }
        crew.tracks_written();
    }

    /// Removes the members that are not finite after a block. They are replayed step by step; after a block of
    /// one step they have failed.
    #[cold]
    #[inline(never)]
    fn part_with<L: Level>(
        &mut self,
        scheme: &M,
        finite: MaskIn<T, P>,
        crew: &mut Crew<T, S>,
        host: &mut dyn Host<T, S>,
    ) {
        let lanes = P::LANES as usize;
        let mut before = vec![T::default(); self.rows.len()];
        store::<L, T, P, _>(&self.before, &mut before);
        let (mut shown, size) = (Vec::new(), self.shown.point().q.len());
        L::enter_at(Show::<'_, _, T, P> {
            times: &self.times,
            made: self.made + 1,
            carried: &self.carried,
            shown: &self.shown,
            rows: &mut shown,
        });
        store::<L, T, P, _>(&self.carried, &mut self.rows);
        Self::write_tracks::<L>(&self.trackers_before, crew);
        let bad: Vec<bool> = (0..P::LANES).map(|lane| !finite.lane(lane)).collect();
        if !self.watchers.is_empty() {
            self.write_sections::<L>(&self.watchers_before, crew);
            self.show::<L>(scheme, self.made, (true, &bad), crew, host);
        }
        let bad = (0..lanes).filter(|lane| bad[*lane]);
        for lane in bad {
            let column = |rows: &[T], c: usize| rows[c * lanes + lane];
            let Some((mut seat, careful)) = crew.take(lane) else {
                continue;
            };
            for (c, word) in seat.words.iter_mut().enumerate() {
                *word = column(&before, c);
            }
            if !careful {
                crew.suspect(seat);
                continue;
            }
            let point: Vec<f64> = (0..2 * size).map(|c| column(&shown, c).to_f64()).collect();
            let alone = (&seat.prepared, &seat.state, seat.step, seat.clock);
            let made = (seat.made, &*seat.words);
            let reached = column(&shown, 2 * size).to_f64();
            let error = explain(scheme, alone, made, &point, reached);
            host.fail(&mut seat, error);
        }
    }

    /// Passes members at their stops to the host, which takes back those that leave.
    #[inline(always)]
    fn arrive<L: Level>(&mut self, scheme: &M, crew: &mut Crew<T, S>, host: &mut dyn Host<T, S>) {
        let lanes = P::LANES as usize;
        let is_any_due = crew.is_any_due();
        if !self.trackers.is_empty() && (is_any_due || crew.has_changed()) {
            Self::write_tracks::<L>(&self.trackers, crew);
        }
        if !is_any_due {
            return;
        }
        if !self.trackers.is_empty() {
            crew.for_each_due(|_, seat| {
                if !seat.follows.drifts.is_empty() {
                    host.follow(seat.key, &mut seat.follows);
                }
                true
            });
        }
        if host.looks() {
            let size = self.shown.point().q.len();
            let carries_duration = L::enter_at(Show::<'_, _, T, P> {
                times: &self.times,
                made: self.made,
                carried: &self.carried,
                shown: &self.shown,
                rows: &mut self.passing_rows,
            });
            let mut rows = self.passing_rows.chunks_exact(lanes);
            for (c, row) in (0..size).zip(&mut rows) {
                crew.show(row, |state| state.q.component_mut(c));
            }
            for (c, row) in (0..size).zip(&mut rows) {
                crew.show(row, |state| state.p.component_mut(c));
            }
            for row in rows.by_ref().take(1) {
                crew.show(row, |state| &mut state.t);
            }
            let durations = rows.next().filter(|_| carries_duration);
            arrivals(scheme, crew, host, durations);
        } else {
            crew.for_each_due(|_, _| false);
        }
        if crew.is_any_leaving() {
            store::<L, T, P, _>(&self.carried, &mut self.rows);
            crew.leave(&self.rows, host);
        }
    }
}

/// A number of each lane.
fn each<T: Real, S: System<T>>(seats: &[&Seat<T, S>], of: impl Fn(&Seat<T, S>) -> T) -> Vec<T> {
    seats.iter().map(|seat| of(seat)).collect()
}

/// Returns a number of steps as a scalar.
fn count<T: Real>(steps: u64) -> T {
    T::constant(steps as i64 as f64, 0.0)
}

/// Returns numbers of steps as scalars.
fn counts<T: Real>(steps: &[u64]) -> Vec<T> {
    steps.iter().map(|n| count(*n)).collect()
}

/// Returns a copy. It is made out of line, since a value in lanes is long and is copied in many places.
#[inline(never)]
fn another<C: Clone>(of: &C) -> C {
    of.clone()
}
