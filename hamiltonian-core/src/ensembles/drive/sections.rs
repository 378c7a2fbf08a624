//! Signs of functions, followed in lanes.
//!
//! Input: the marks of a block. Output: states passed to observers: those after which a sign may have changed and the
//! two before each. Invariant: afterwards an observer has the data that it would have after receiving every state.

use super::packed::{CarriedAt, SectionRows, When};
use super::scalar::PassedStates;
use super::{Driver, number_of_each};
use crate::ensembles::host::MemberRun;
use crate::observers::observe::MemberSection;
use crate::schemes::scheme::Scheme;
use crate::systems::system::System;
use alloc::vec;
use alloc::vec::Vec;
use hamiltonian_lanes::Real;

impl<T: Real, S: System, M: Scheme<S>, const FOLLOWS: bool> Driver<'_, T, S, M, FOLLOWS> {
    /// Loads the functions whose sign is followed for at least one member into lanes.
    pub(super) fn load_sections(&mut self) {
        let runs = self.occupants.runs();
        let has_sections = runs.iter().map(|run| !run.followed.sections.is_empty());
        let has_sections: Vec<bool> = has_sections.collect();
        if self.sections.is_empty() && !has_sections.contains(&true) {
            return;
        }
        self.sections.clear();
        for section in runs.iter().flat_map(|run| &run.followed.sections) {
            let mut known = self.sections.iter();
            if !known.any(|other| other.is_of(section)) {
                self.sections.push(*section);
            }
        }
        let rows_of = |function: &MemberSection<T>| {
            let in_lanes = |number: fn(&MemberSection<T>) -> T| {
                number_of_each(&runs, |run: &MemberRun<T, S>| {
                    let mut own = run.followed.sections.iter();
                    let own = own.find(|section| section.is_of(function));
                    own.map_or(T::zero(), number)
                })
            };
            SectionRows {
                function: *function,
                rows: [
                    in_lanes(|section| section.value),
                    in_lanes(|section| section.value - section.change),
                ],
            }
        };
        let sections: Vec<_> = self.sections.iter().map(rows_of).collect();
        self.lanes.load_sections(&sections, &has_sections);
        self.section_lanes = has_sections;
    }

    /// Writes the values of the functions back into the runs.
    pub(super) fn write_sections(&mut self, when: When) {
        let mut rows = [(); 2].map(|()| vec![T::zero(); self.section_lanes.len()]);
        for (k, function) in self.sections.iter().enumerate() {
            self.lanes.store_section(k, when, &mut rows);
            let [values, before] = &rows;
            // A member whose sections were not yet in the lanes keeps its own values.
            let which = |lane: usize| self.section_lanes[lane];
            self.occupants.for_each_with_sections(which, |lane, run| {
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
    pub(super) fn pass_marked(&mut self, n: u64) {
        let mut which = vec![false; self.section_lanes.len()];
        let mut mark = 0;
        while let Some(step) = self.lanes.mark(mark, &mut which) {
            self.pass_states(step, (false, &which));
            mark += 1;
        }
        if self.occupants.is_any_due_with_sections(n) {
            which.fill(false);
            self.occupants.for_each_with_sections(
                |_| true,
                |lane, run| {
                    which[lane] = run.made + n == run.stop;
                    true
                },
            );
            self.lanes.take_last();
            self.pass_states(self.made + n, (true, &which));
        }
    }

    /// Passes the states after a step and after the two steps before it, the last three of the lanes, to the observers of
    /// some lanes, except states that they have received. `signs_kept` is true if no sign changed in the step.
    pub(super) fn pass_states(&mut self, step: u64, (signs_kept, which): (bool, &[bool])) {
        let ahead = step - self.made;
        let has_parts = self.lanes.has_parts();
        for (back, at) in [(2, 0), (1, 1), (0, 2)] {
            let made = step.wrapping_sub(back);
            let carries_duration = self.lanes.close_last(at, made, &mut self.passed);
            if has_parts {
                self.lanes.store(CarriedAt::Last(at), &mut self.rows);
            }
            let passed = PassedStates {
                rows: &self.passed,
                carries_duration,
                which,
                ahead,
                back,
                signs_kept: signs_kept || back > 0,
                words: has_parts.then_some(&*self.rows),
            };
            passed.pass(self.scheme, &mut self.occupants, self.host);
        }
        if self.occupants.is_any_leaving() {
            self.lanes.store(CarriedAt::Last(2), &mut self.rows);
            self.occupants.leave(&self.rows, self.host);
        }
    }
}
