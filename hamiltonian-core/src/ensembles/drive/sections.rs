//! Signs of functions, followed in lanes.
//!
//! Input: the marks of a block. Output: states passed to observers: those after which a sign may have changed and the
//! two before each. Invariant: afterwards an observer has the data that it would have after receiving every state.

use super::scalar::PassedStates;
use super::transfer::{gather, lanes_of, scatter, store};
use super::{Lanes, number_of_each};
use crate::ensembles::close::Close;
use crate::ensembles::host::{Host, MemberRun};
use crate::ensembles::occupants::Occupants;
use crate::flows::map::Map;
use crate::observers::observe::{LaneSection, MemberSection};
use crate::schemes::scheme::Scheme;
use crate::systems::system::System;
use alloc::vec;
use alloc::vec::Vec;
use hamiltonian_lanes::{Level, Mask, Pack, Real};

impl<T, S, P, M> Lanes<T, S, P, M>
where
    T: Real,
    P: Pack,
    S: System,
    M: Scheme<S>,
{
    /// Loads the functions whose sign is followed for at least one member into lanes.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn load_sections<L: Level>(&mut self, runs: &[&MemberRun<T, S>]) {
        self.sections.clear();
        self.sections_before.clear();
        self.member_sections.clear();
        let has_sections = runs.iter().map(|run| !run.followed.sections.is_empty());
        if !has_sections.clone().any(|has| has) {
            self.section_lanes = Mask::splat(false);
            return;
        }
        self.section_lanes = lanes_of::<L, T, P>(&has_sections.collect::<Vec<bool>>());
        for section in runs.iter().flat_map(|run| &run.followed.sections) {
            let mut known = self.member_sections.iter();
            if !known.any(|other| other.is_of(section)) {
                self.member_sections.push(*section);
            }
        }
        for function in &self.member_sections {
            let of = |run: &MemberRun<T, S>, number: fn(&MemberSection<T>) -> T| {
                let mut own = run.followed.sections.iter();
                let own = own.find(|section| section.is_of(function));
                own.map_or(T::zero(), number)
            };
            let in_lanes =
                |number: fn(&MemberSection<T>) -> T| number_of_each(runs, |run| of(run, number));
            let period = function.period.map(T::spread::<P>);
            self.sections
                .push(LaneSection::new(function.observable, period));
            self.sections_before
                .push(LaneSection::new(function.observable, period));
            let numbers: [fn(&MemberSection<T>) -> T; 2] = [
                |section| section.value,
                |section| section.value - section.change,
            ];
            let last = self.sections.last_mut().map(LaneSection::values_mut);
            for (number, value) in numbers.into_iter().zip(last.into_iter().flatten()) {
                gather::<L, T, P>(&in_lanes(number), value);
            }
        }
    }

    /// Writes the values of the functions back into the runs.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn write_sections<L: Level>(
        &self,
        sections: &[LaneSection<T::Over<P>>],
        occupants: &mut Occupants<T, S>,
    ) {
        if self.member_sections.is_empty() {
            return;
        }
        let [mut values, mut before] = [(); 2].map(|()| vec![T::zero(); P::LANES as usize]);
        for (function, lane_section) in self.member_sections.iter().zip(sections) {
            let [last, one_before] = lane_section.last();
            scatter::<L, T, P>(last, &mut values);
            scatter::<L, T, P>(one_before, &mut before);
            // A member whose sections were not yet in the lanes keeps its own values.
            let which = |lane: usize| self.section_lanes.lane(lane as u32);
            occupants.for_each_with_sections(which, |lane, run| {
                let mut own = run.followed.sections.iter_mut();
                if let Some(section) = own.find(|section| section.is_of(function)) {
                    (section.value, section.change) = (values[lane], values[lane] - before[lane]);
                }
                true
            });
        }
    }

    /// Passes the states of marked steps, in their order, to the observers that follow signs. Observers of members at
    /// their stops also receive the state after the last of the `n` steps.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(super) fn pass_marked<L: Level>(
        &mut self,
        scheme: &M,
        n: u64,
        occupants: &mut Occupants<T, S>,
        host: &mut dyn Host<T, S>,
    ) {
        let steps = core::mem::take(&mut self.marks.steps);
        for (mark, (step, lanes)) in steps.iter().enumerate() {
            let which: Vec<bool> = (0..P::LANES).map(|lane| lanes.lane(lane)).collect();
            self.last_three.clone_from(self.marks.states(mark));
            self.pass_states::<L>(scheme, *step, (false, &which), occupants, host);
        }
        self.marks.steps = steps;
        if occupants.is_any_due_with_sections(n) {
            let mut which = vec![false; P::LANES as usize];
            occupants.for_each_with_sections(
                |_| true,
                |lane, run| {
                    which[lane] = run.made + n == run.stop;
                    true
                },
            );
            self.marks.copy_last(&mut self.last_three);
            self.pass_states::<L>(scheme, self.made + n, (true, &which), occupants, host);
        }
    }

    /// Passes the states after a step and after the two steps before it to the observers of some lanes, except states
    /// that they have received. `last_three` has the carried values. `signs_kept` is true if no sign changed in the
    /// step.
    #[inline(never)]
    pub(super) fn pass_states<L: Level>(
        &mut self,
        scheme: &M,
        step: u64,
        (signs_kept, which): (bool, &[bool]),
        occupants: &mut Occupants<T, S>,
        host: &mut dyn Host<T, S>,
    ) {
        let ahead = step - self.made;
        for (back, carried) in [2, 1, 0].into_iter().zip(&self.last_three) {
            let (carries_duration, _) = L::enter(Close::<'_, _, T, P> {
                map: &self.map,
                times: &self.times,
                made: step.wrapping_sub(back),
                carried,
                shown: &mut self.passed,
                rows: &mut self.passed_rows,
            });
            let has_parts = self.map.has_parts();
            if has_parts {
                store::<L, T, P, _>(carried, &mut self.rows);
            }
            let passed = PassedStates {
                rows: &self.passed_rows,
                carries_duration,
                which,
                ahead,
                back,
                signs_kept: signs_kept || back > 0,
                words: has_parts.then_some(&*self.rows),
            };
            passed.pass(scheme, occupants, host);
        }
        if occupants.is_any_leaving() {
            store::<L, T, P, _>(&self.last_three[2], &mut self.rows);
            occupants.leave(&self.rows, host);
        }
    }
}
