//! Integration of members to their ends, in the lanes of a pack.
//!
//! Input: a scheme and a host. Output: the host has received every member at each of its stops. Invariants:
//! a member's bits depend only on its own run and on the arithmetic of the pack. Lanes are refilled only between
//! blocks. A member that fails does not delay the others, since it is replayed after them. The driver is compiled once for
//! all levels: [`Packed`] is its way to the lanes.

pub(super) mod deviations;
mod lanes;
mod packed;
mod scalar;
mod sections;
mod transfer;

use self::lanes::Lanes;
use self::packed::{BlockEnd, BlockSteps, CarriedAt, DriftRows, Packed, When};
use self::scalar::{explain, pass_to_host};
use super::block::Opening;
use super::host::{Host, MemberRun};
use super::occupants::Occupants;
use crate::observers::observe::{MemberSection, Quantity};
use crate::schemes::scheme::{CarriedBy, Scheme};
use crate::systems::state::State;
use crate::systems::system::{Dynamics, System, VectorOf};
use crate::systems::vector::Vector;
use alloc::vec;
use alloc::vec::Vec;
use hamiltonian_lanes::{Level, Pack, Real};

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
pub(super) fn drive<L, T, S, P, M, const FOLLOWS: bool>(scheme: &M, host: &mut dyn Host<T, S>)
where
    L: Level,
    T: Real,
    S: System,
    P: Pack,
    M: Scheme<S>,
{
    let Some(first) = Occupied::first(P::LANES as usize, host) else {
        return;
    };
    let systems = first.systems();
    let mut lanes =
        Lanes::<L, T, S, P, M, FOLLOWS>::new(scheme, &systems, &first.steps, first.state());
    first.drive::<M, FOLLOWS>(scheme, host, &mut lanes);
}

/// The first members in the lanes, with the step of each.
struct Occupied<T: Real, S: System> {
    occupants: Occupants<T, S>,
    steps: Vec<T>,
}

impl<T: Real, S: System> Occupied<T, S> {
    /// Fills the lanes; `None` if the host has no members.
    #[inline(never)]
    fn first(lanes: usize, host: &mut dyn Host<T, S>) -> Option<Self> {
        let mut occupants = Occupants::new(lanes);
        if !occupants.fill(host) {
            return None;
        }
        let steps = number_of_each(&occupants.runs(), |run| run.step);
        Some(Occupied { occupants, steps })
    }

    /// Returns the system of each lane.
    #[inline(never)]
    fn systems(&self) -> Vec<&S::Prepared<T>> {
        systems_of(&self.occupants.runs())
    }

    /// Returns a state of the members' shape.
    #[inline(never)]
    fn state(&self) -> &State<VectorOf<S, T>> {
        &self.occupants.runs()[0].state
    }

    /// Drives all members to their ends, in lanes that were made for these.
    #[inline(never)]
    fn drive<M: Scheme<S>, const FOLLOWS: bool>(
        self,
        scheme: &M,
        host: &mut dyn Host<T, S>,
        lanes: &mut dyn Packed<T, S>,
    ) {
        Driver::<'_, T, S, M, FOLLOWS> {
            scheme,
            host,
            lanes,
            uniform: is_uniform(&self.occupants.runs()),
            occupants: self.occupants,
            steps: self.steps,
            is_prepared: true,
            made: 0,
            drifts: Vec::new(),
            begins: false,
            sections: Vec::new(),
            section_lanes: Vec::new(),
            closes: false,
            rows: Vec::new(),
            shown: Vec::new(),
            passed: Vec::new(),
        }
        .run();
    }
}

/// The members of a host on their way through lanes.
struct Driver<'a, T: Real, S: System, M, const FOLLOWS: bool> {
    scheme: &'a M,
    host: &'a mut dyn Host<T, S>,
    lanes: &'a mut dyn Packed<T, S>,
    occupants: Occupants<T, S>,
    /// Steps since the occupants last changed.
    made: u64,
    /// The quantities whose drift is followed.
    drifts: Vec<Quantity>,
    /// True if the drift of a member begins at its current state.
    begins: bool,
    /// The functions whose sign is followed.
    sections: Vec<MemberSection<T>>,
    /// The lanes whose observers follow signs.
    section_lanes: Vec<bool>,
    /// True if any followed quantity depends on what the closing piece of a step changes.
    closes: bool,
    /// True if the map was prepared for the current occupants before they were loaded into the lanes.
    is_prepared: bool,
    /// The step of each lane for which the map was prepared.
    steps: Vec<T>,
    /// True if all lanes have the same parameters.
    uniform: bool,
    /// Carried values of the lanes, component by component.
    rows: Vec<T>,
    /// The closed states at the end of the last block, in rows.
    shown: Vec<T>,
    /// Scratch for the states that observers of signs receive between stops.
    passed: Vec<T>,
}

impl<T: Real, S: System, M: Scheme<S>, const FOLLOWS: bool> Driver<'_, T, S, M, FOLLOWS> {
    fn run(&mut self) {
        while !self.host.is_cancelled() {
            self.load_lanes();
            // The first value of a drift is that at the start, so a block without steps evaluates it.
            let begins = core::mem::take(&mut self.begins);
            let n = match begins {
                true => 0,
                false => self.occupants.steps(BLOCK, self.host),
            };
            let steps = BlockSteps {
                made: self.made,
                n,
                energy: self.drifts.contains(&Quantity::Energy),
                closes: self.closes,
                schedule: &self.occupants.schedule(),
            };
            let BlockEnd {
                n,
                carries_duration,
                is_finite,
            } = self.lanes.block(steps, &mut self.shown);
            if begins {
                self.occupants.begin_drifts();
            }
            let inside = match n {
                0 => vec![true; self.steps.len()],
                _ => self.occupants.inside(&self.shown),
            };
            if !is_finite || inside.contains(&false) {
                self.remove_failed(inside);
            }
            if self.has_sections() {
                self.pass_marked(n);
            }
            self.occupants.made(n);
            self.made += n;
            self.pass_due(carries_duration);
            if !self.occupants.fill(self.host) {
                return;
            }
        }
    }

    /// Loads occupants that have changed into the lanes.
    fn load_lanes(&mut self) {
        let Some(changed) = self.occupants.changed() else {
            return;
        };
        if self.has_sections() {
            self.write_sections(When::Now);
        }
        let runs = self.occupants.runs();
        self.rows
            .resize(runs[0].words.len() * runs.len(), T::zero());
        self.lanes.store(CarriedAt::Now, &mut self.rows);
        self.occupants.write_columns(&mut self.rows);
        let runs = self.occupants.runs();
        let steps = number_of_each(&runs, |run| run.step);
        let others = changed.parameters || !self.uniform || steps != self.steps;
        if !core::mem::take(&mut self.is_prepared) && others {
            self.lanes.prepare(&systems_of(&runs), &steps);
            self.steps = steps;
            self.uniform = is_uniform(&runs);
        }
        self.lanes.load(&self.rows);
        self.made = 0;
        let clocks = [
            number_of_each(&runs, |run| run.clock.start),
            number_of_each(&runs, |run| run.clock.interval),
            number_of_each(&runs, |run| as_scalar(run.made)),
        ];
        self.lanes.set_clocks(clocks.each_ref().map(|row| &**row));
        let at_start: Vec<bool> = runs.iter().map(|run| run.made == run.began).collect();
        self.lanes
            .set_opening(match (changed.any_at_start, changed.all_at_start) {
                (_, true) => Opening::Open,
                (false, _) => Opening::Join,
                _ => Opening::Mixed(&at_start),
            });
        if const { FOLLOWS } {
            self.load_followed();
        }
    }

    /// Returns true if the drift of a quantity is followed.
    fn has_drifts(&self) -> bool {
        FOLLOWS && !self.drifts.is_empty()
    }

    /// Returns true if the sign of a function is followed.
    fn has_sections(&self) -> bool {
        FOLLOWS && !self.sections.is_empty()
    }

    /// Loads what lanes follow for observers.
    fn load_followed(&mut self) {
        self.load_drifts();
        self.load_sections();
        let closing = self.lanes.closing();
        let system = self.occupants.runs()[0].prepared.description();
        let sections = self.sections.iter().map(|section| section.observable);
        let mut quantities = self
            .drifts
            .iter()
            .copied()
            .chain(sections.map(Quantity::Observable));
        self.closes = quantities.any(|quantity| {
            let reads = quantity.reads(system);
            (0..2).any(|half| closing[half] && reads[half])
        });
    }

    /// Loads the drifts of the members into lanes.
    fn load_drifts(&mut self) {
        let runs = self.occupants.runs();
        // The first followed member determines the quantities; members that differ receive states at their stops.
        let first = runs.iter().find(|run| !run.followed.drifts.is_empty());
        let drifts = first.map_or(&[][..], |run| &run.followed.drifts);
        if drifts.is_empty() && self.drifts.is_empty() {
            return;
        }
        self.drifts = drifts.iter().map(|track| track.quantity).collect();
        let mut begins = vec![false; runs.len()];
        let mut rows_of = |(k, quantity): (usize, &Quantity)| {
            let mut rows = [(); 4].map(|()| vec![T::zero(); runs.len()]);
            for (lane, run) in runs.iter().enumerate() {
                let Some(track) = run.followed.drifts.get(k) else {
                    continue;
                };
                let Some(drift) = &track.drift else {
                    begins[lane] = true;
                    continue;
                };
                let number = |number| T::constant(number, 0.0);
                rows[0][lane] = drift.start;
                rows[1][lane] = number(drift.max);
                rows[2][lane] = number(drift.sum_of_sizes);
                rows[3][lane] = number(drift.sum);
            }
            DriftRows {
                quantity: *quantity,
                rows,
            }
        };
        let drifts: Vec<_> = self.drifts.iter().enumerate().map(&mut rows_of).collect();
        self.begins = begins.contains(&true);
        self.lanes
            .load_drifts(&drifts, self.begins.then_some(&*begins));
    }

    /// Writes the drifts back into the runs.
    fn write_drifts(&mut self, when: When) {
        let mut rows = [(); 4].map(|()| vec![T::zero(); self.steps.len()]);
        for k in 0..self.drifts.len() {
            self.lanes.store_drift(k, when, &mut rows);
            self.occupants.write_drift(k, &rows);
        }
        self.occupants.drifts_written();
    }

    /// Removes the members that are not finite after a block, or not inside the domain of H. They will be replayed step by
    /// step. A member that is being replayed is passed to the host with its error.
    #[cold]
    #[inline(never)]
    fn remove_failed(&mut self, inside: Vec<bool>) {
        let lanes = self.steps.len();
        let [mut numbers, mut energies] = [(); 2].map(|()| vec![true; lanes]);
        self.lanes.finite(&mut numbers, &mut energies);
        let is_bad = |lane: usize| !(numbers[lane] && energies[lane] && inside[lane]);
        let bad: Vec<bool> = (0..lanes).map(is_bad).collect();
        let mut before = vec![T::zero(); self.rows.len()];
        self.lanes.store(CarriedAt::Before, &mut before);
        if self.has_drifts() {
            self.write_drifts(When::Before);
        }
        if self.has_sections() {
            self.write_sections(When::Before);
            self.pass_states(self.made, (true, &bad));
        }
        for lane in (0..lanes).filter(|lane| bad[*lane]) {
            let Some((mut run, replaying)) = self.occupants.take(lane) else {
                continue;
            };
            for (row, word) in before.chunks_exact(lanes).zip(&mut run.words) {
                *word = row[lane];
            }
            if !replaying {
                self.occupants.add_pending(run);
                continue;
            }
            let shown = self.shown.chunks_exact(lanes).map(|row| row[lane].to_f64());
            let shown: Vec<f64> = shown.collect();
            let (point, reached) = shown.split_at(2 * run.state.q.len());
            let single = (&run.prepared, &run.state, run.step, run.clock);
            let made = (run.made, run.made == run.began, &*run.words);
            // In the lanes of `numbers`, only H is not finite.
            let error = explain(
                self.scheme,
                single,
                made,
                (point, reached[0]),
                numbers[lane],
            );
            self.host.fail(&mut run, error);
        }
    }

    /// Passes members at their stops to the host, which takes back those that leave.
    fn pass_due(&mut self, carries_duration: bool) {
        let is_any_due = self.occupants.is_any_due();
        if self.has_drifts() && (is_any_due || self.occupants.has_changed()) {
            self.write_drifts(When::Now);
        }
        if !is_any_due {
            return;
        }
        if self.has_drifts() {
            let Driver {
                occupants, host, ..
            } = self;
            occupants.for_each_due(|_, run| {
                if !run.followed.drifts.is_empty() {
                    host.take_drifts(run.key, run.prepared.description(), &mut run.followed);
                }
                true
            });
        }
        let Driver {
            occupants, host, ..
        } = self;
        if host.observes() {
            let has_parts = self.lanes.has_parts();
            if has_parts {
                self.lanes.store(CarriedAt::Now, &mut self.rows);
            }
            let states = (&*self.shown, carries_duration);
            let words = has_parts.then_some(&*self.rows);
            pass_to_host(self.scheme, occupants, *host, states, words);
        } else {
            occupants.for_each_due(|_, _| false);
        }
        if self.occupants.is_any_leaving() {
            self.lanes.store(CarriedAt::Now, &mut self.rows);
            self.occupants.leave(&self.rows, self.host);
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

/// Returns the system of each run.
fn systems_of<'a, T: Real, S: System>(runs: &[&'a MemberRun<T, S>]) -> Vec<&'a S::Prepared<T>> {
    runs.iter().map(|run| &run.prepared).collect()
}

/// Returns true if all runs have the same parameters.
fn is_uniform<T: Real, S: System>(runs: &[&MemberRun<T, S>]) -> bool {
    let mut pairs = runs.windows(2);
    pairs.all(|pair| S::equals(&pair[0].prepared, &pair[1].prepared))
}

/// Returns a number of steps as a scalar.
fn as_scalar<T: Real>(steps: u64) -> T {
    T::constant(steps as i64 as f64, 0.0)
}

/// Returns numbers of steps as scalars.
fn as_scalars<T: Real>(steps: &[u64]) -> Vec<T> {
    steps.iter().map(|n| as_scalar(*n)).collect()
}
