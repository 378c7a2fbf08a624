//! Members in the lanes of one pack type, with the map of their steps and the quantities that observers follow.
//!
//! Input: numbers of members, lane by lane. Output: the same after a block of steps. Invariant: operations of packs stand
//! in kernels, which enter the level; the functions around them only move numbers.

use super::packed::{BlockEnd, BlockSteps, CarriedAt, DriftRows, Packed, SectionRows, When};
use super::transfer::{Begin, FlagsOf, Prepare, gather, lanes_of, load, scatter, store};
use super::{CarriedIn, MapIn, MaskIn, as_scalars};
use crate::ensembles::block::{Block, Followed, LaneSchedule, Opening};
use crate::ensembles::close::{Close, WriteRows};
use crate::ensembles::marks::{LastThree, Marks};
use crate::flows::map::{Clock, Map};
use crate::observers::observe::{LaneDrift, LaneSection, Quantity};
use crate::schemes::scheme::Scheme;
use crate::systems::flow::Scratch;
use crate::systems::state::State;
use crate::systems::system::{System, VectorOf};
use crate::systems::vector::Vector;
use alloc::vec::Vec;
use core::marker::PhantomData;
use hamiltonian_lanes::{Kernel, Level, Mask, Pack, Real};

/// The occupants in lanes, inside the level `L` of the pack. Without `FOLLOWS` they follow nothing for observers, and no
/// code is compiled for it.
pub(super) struct Lanes<'m, L, T, S, P, M, const FOLLOWS: bool>
where
    T: Real,
    P: Pack,
    S: System,
    M: Scheme<S>,
{
    scheme: &'m M,
    prepared: S::Prepared<T::Over<P>>,
    map: MapIn<T, S, P, M>,
    work: <MapIn<T, S, P, M> as Map>::Work,
    carried: CarriedIn<T, S, P, M>,
    /// The carried value at the beginning of the block.
    before: CarriedIn<T, S, P, M>,
    /// The closed state.
    shown: CarriedIn<T, S, P, M>,
    clock: Clock<T::Over<P>>,
    opening: Opening<MaskIn<T, P>>,
    /// The lanes in which all numbers are finite, and those in which H is so wherever a block evaluates it.
    finite: [MaskIn<T, P>; 2],
    /// The drifts that are followed, and the same at the beginning of the block.
    drifts: Vec<LaneDrift<T::Over<P>>>,
    drifts_before: Vec<LaneDrift<T::Over<P>>>,
    /// The functions whose sign is followed, with their values, and the same at the beginning of the block.
    sections: Vec<LaneSection<T::Over<P>>>,
    sections_before: Vec<LaneSection<T::Over<P>>>,
    /// The lanes whose observers follow signs.
    section_lanes: MaskIn<T, P>,
    marks: Marks<CarriedIn<T, S, P, M>, MaskIn<T, P>>,
    /// The carried values after three consecutive steps.
    last_three: LastThree<CarriedIn<T, S, P, M>>,
    /// Scratch for the states that observers of signs receive between stops.
    passed: CarriedIn<T, S, P, M>,
    /// The lanes whose drift begins at their current state.
    attach: Option<MaskIn<T, P>>,
    /// The steps after which the observers of lanes receive states, if the lanes differ.
    schedule: LaneSchedule<T::Over<P>>,
    level: PhantomData<L>,
}

impl<'m, L, T, S, P, M, const FOLLOWS: bool> Lanes<'m, L, T, S, P, M, FOLLOWS>
where
    L: Level,
    T: Real,
    P: Pack,
    S: System,
    M: Scheme<S>,
{
    /// Makes lanes in the shape of a state. Carried values are loaded afterwards.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn new(
        scheme: &'m M,
        systems: &[&S::Prepared<T>],
        steps: &[T],
        state: &State<VectorOf<S, T>>,
    ) -> Self {
        let (prepared, map) = L::enter(Prepare::<T, S, P, M>::new(scheme, systems, steps));
        let begin = Begin::<T, S, P, M>::new(scheme, &prepared, state, steps);
        let carried = L::enter(begin);
        Lanes {
            scheme,
            map,
            work: Scratch::like(&carried),
            before: cloned(&carried),
            marks: Marks::new([cloned(&carried), cloned(&carried), cloned(&carried)]),
            last_three: [cloned(&carried), cloned(&carried), cloned(&carried)],
            sections: Vec::new(),
            sections_before: Vec::new(),
            passed: cloned(&carried),
            section_lanes: Mask::splat(false),
            shown: cloned(&carried),
            carried,
            clock: Clock::default(),
            opening: Opening::Open,
            finite: [Mask::splat(true); 2],
            prepared,
            drifts: Vec::new(),
            drifts_before: Vec::new(),
            attach: None,
            schedule: LaneSchedule::default(),
            level: PhantomData,
        }
    }
}

impl<L, T, S, P, M, const FOLLOWS: bool> Packed<T, S> for Lanes<'_, L, T, S, P, M, FOLLOWS>
where
    L: Level,
    T: Real,
    P: Pack,
    S: System,
    M: Scheme<S>,
{
    fn prepare(&mut self, systems: &[&S::Prepared<T>], steps: &[T]) {
        let prepare = Prepare::<T, S, P, M>::new(self.scheme, systems, steps);
        (self.prepared, self.map) = L::enter(prepare);
    }

    fn closing(&self) -> [bool; 2] {
        self.map.closing()
    }

    fn has_parts(&self) -> bool {
        self.map.has_parts()
    }

    fn load(&mut self, rows: &[T]) {
        load::<L, T, P, _>(rows, &mut self.carried);
        self.marks.replace(&self.carried);
    }

    fn store(&self, values: CarriedAt, rows: &mut [T]) {
        let values = match values {
            CarriedAt::Now => &self.carried,
            CarriedAt::Before => &self.before,
            CarriedAt::Last(at) => &self.last_three[at],
        };
        store::<L, T, P, _>(values, rows);
    }

    fn set_clocks(&mut self, numbers: [&[T]; 3]) {
        let Clock {
            start,
            interval,
            first,
        } = &mut self.clock;
        for (numbers, into) in numbers.into_iter().zip([start, interval, first]) {
            gather::<L, T, P>(numbers, into);
        }
    }

    fn set_opening(&mut self, opening: Opening<&[bool]>) {
        self.opening = match opening {
            Opening::Open => Opening::Open,
            Opening::Join => Opening::Join,
            Opening::Mixed(at_start) => Opening::Mixed(lanes_of::<L, T, P>(at_start)),
        };
    }

    fn load_drifts(&mut self, drifts: &[DriftRows<T>], begins: Option<&[bool]>) {
        if const { !FOLLOWS } {
            return;
        }
        let any = self.clock.start;
        let new = |drift: &DriftRows<T>| LaneDrift::new(drift.quantity, any);
        self.drifts.clear();
        self.drifts.extend(drifts.iter().map(new));
        for (drift, lane_drift) in drifts.iter().zip(&mut self.drifts) {
            for (numbers, into) in drift.rows.iter().zip(lane_drift.numbers_mut()) {
                gather::<L, T, P>(numbers, into);
            }
        }
        self.drifts_before.clone_from(&self.drifts);
        self.attach = begins.map(lanes_of::<L, T, P>);
    }

    fn store_drift(&self, k: usize, when: When, rows: &mut [Vec<T>; 4]) {
        if const { !FOLLOWS } {
            return;
        }
        let drifts = match when {
            When::Now => &self.drifts,
            When::Before => &self.drifts_before,
        };
        for (row, pack) in rows.iter_mut().zip(drifts[k].numbers()) {
            scatter::<L, T, P>(pack, row);
        }
    }

    fn load_sections(&mut self, sections: &[SectionRows<T>], lanes: &[bool]) {
        if const { !FOLLOWS } {
            return;
        }
        self.section_lanes = lanes_of::<L, T, P>(lanes);
        self.sections.clear();
        for SectionRows { function, rows } in sections {
            let mut numbers = self.clock.start;
            let period = function.period.map(|period| {
                gather::<L, T, P>(&[period], &mut numbers);
                numbers
            });
            let mut section = LaneSection::new(function.observable, period, numbers);
            for (row, value) in rows.iter().zip(section.values_mut()) {
                gather::<L, T, P>(row, value);
            }
            self.sections.push(section);
        }
        self.sections_before.clone_from(&self.sections);
    }

    fn store_section(&self, k: usize, when: When, rows: &mut [Vec<T>; 2]) {
        if const { !FOLLOWS } {
            return;
        }
        let sections = match when {
            When::Now => &self.sections,
            When::Before => &self.sections_before,
        };
        for (row, value) in rows.iter_mut().zip(sections[k].last()) {
            scatter::<L, T, P>(value, row);
        }
    }

    fn block(&mut self, steps: BlockSteps<'_>, rows: &mut Vec<T>) -> BlockEnd {
        if let Some([left, interval]) = &steps.schedule.by_lane {
            gather::<L, T, P>(&as_scalars(left), &mut self.schedule.left);
            gather::<L, T, P>(&as_scalars(interval), &mut self.schedule.interval);
        }
        L::enter(RunBlock {
            lanes: self,
            steps,
            rows,
        })
    }

    fn finite(&self, numbers: &mut [bool], energies: &mut [bool]) {
        for (mask, flags) in self.finite.iter().zip([numbers, energies]) {
            L::enter(FlagsOf { mask, flags });
        }
    }

    fn mark(&mut self, k: usize, lanes: &mut [bool]) -> Option<u64> {
        if const { !FOLLOWS } {
            return None;
        }
        let (step, mask) = self.marks.steps.get(k)?;
        L::enter(FlagsOf { mask, flags: lanes });
        self.last_three.clone_from(self.marks.states(k));
        Some(*step)
    }

    fn take_last(&mut self) {
        if const { !FOLLOWS } {
            return;
        }
        self.marks.copy_last(&mut self.last_three);
    }

    fn close_last(&mut self, at: usize, made: u64, rows: &mut Vec<T>) -> bool {
        if const { !FOLLOWS } {
            return false;
        }
        let (carries_duration, _) = L::enter(Close::<'_, _, T, P> {
            map: &self.map,
            clock: self.clock,
            made,
            carried: &self.last_three[at],
            shown: &mut self.passed,
            rows,
        });
        carries_duration
    }
}

/// A block of steps, with what comes before and after it in lanes.
struct RunBlock<'a, 'm, L, T, S, P, M, const FOLLOWS: bool>
where
    T: Real,
    P: Pack,
    S: System,
    M: Scheme<S>,
{
    lanes: &'a mut Lanes<'m, L, T, S, P, M, FOLLOWS>,
    steps: BlockSteps<'a>,
    rows: &'a mut Vec<T>,
}

impl<A, T, S, P, M, const FOLLOWS: bool> Kernel for RunBlock<'_, '_, A, T, S, P, M, FOLLOWS>
where
    T: Real,
    P: Pack,
    S: System,
    M: Scheme<S>,
{
    type Output = BlockEnd;

    #[cfg_attr(not(unoptimised), inline(always))]
    fn run<L: Level>(self) -> BlockEnd {
        let RunBlock { lanes, steps, rows } = self;
        let BlockSteps {
            made,
            n,
            energy,
            closes,
            schedule,
        } = steps;
        lanes.before.copy_from(&lanes.carried);
        if FOLLOWS {
            lanes.drifts_before.copy_from_slice(&lanes.drifts);
        }
        if FOLLOWS && !lanes.sections.is_empty() {
            lanes.sections_before.copy_from_slice(&lanes.sections);
            lanes.marks.copy_last(&mut lanes.last_three);
            lanes.marks.steps.clear();
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
            by_lane: schedule.by_lane.as_ref().map(|_| &mut lanes.schedule),
            attach: lanes.attach.take(),
        };
        let (mut finite, end) = L::enter(Block::<_, _, _, FOLLOWS> {
            map: &lanes.map,
            clock: lanes.clock,
            made,
            n,
            opening: lanes.opening,
            carried: &mut lanes.carried,
            shown: &mut lanes.shown,
            spare: &mut lanes.passed,
            work: &mut lanes.work,
            followed,
            marks: &mut lanes.marks,
        });
        let carries_duration;
        if FOLLOWS && !closes && end < made + n {
            (carries_duration, finite) = L::enter(Close::<'_, _, T, P> {
                map: &lanes.map,
                clock: lanes.clock,
                made: end,
                carried: &lanes.carried,
                shown: &mut lanes.shown,
                rows,
            });
        } else {
            carries_duration = L::enter(WriteRows::<'_, _, T, P> {
                clock: lanes.clock,
                made: end,
                carried: &lanes.carried,
                shown: &lanes.shown,
                rows,
            });
        }
        let n = end - made;
        let mut energies = MaskIn::<T, P>::splat(true);
        if n > 0 {
            lanes.opening = Opening::Join;
            for drift in lanes.drifts.iter().filter(|_| FOLLOWS) {
                if drift.quantity == Quantity::Energy {
                    energies = energies & drift.numbers()[2].finite();
                }
            }
        }
        lanes.finite = [finite, energies];
        BlockEnd {
            n,
            carries_duration,
            is_finite: (finite & energies).all(),
        }
    }
}

/// Returns a copy. The function is not inlined, since values in lanes are long and are copied in many places.
#[inline(never)]
fn cloned<C: Clone>(of: &C) -> C {
    of.clone()
}
