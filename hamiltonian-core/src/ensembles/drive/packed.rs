//! The lanes of members as their driver sees them: the only part of it that is compiled for each level.
//!
//! Input: numbers of members, lane by lane. Output: the same after a block of steps. Invariant: no type here depends on the
//! level, on the pack or on the map.

use crate::ensembles::block::Opening;
use crate::ensembles::occupants::Schedule;
use crate::observers::observe::{MemberSection, Quantity};
use crate::systems::system::System;
use alloc::vec::Vec;
use hamiltonian_lanes::Real;

/// Members in the lanes of a pack. Rows have a number of each lane, and there is one for each component.
pub(super) trait Packed<T: Real, S: System> {
    /// Combines the systems of the lanes into one, and makes the map of its steps.
    fn prepare(&mut self, systems: &[&S::Prepared<T>], steps: &[T]);
    /// Returns whether the closing piece of a step changes coordinates, and whether it changes momenta.
    fn closing(&self) -> [bool; 2];
    /// Returns true if the map makes parts of its steps.
    fn has_parts(&self) -> bool;
    /// Reads the carried values after a change of the members.
    fn load(&mut self, rows: &[T]);
    /// Writes carried values.
    fn store(&self, values: CarriedAt, rows: &mut [T]);
    /// Sets the times at which the lanes started, the durations of their steps and the steps that they have made.
    fn set_clocks(&mut self, numbers: [&[T]; 3]);
    /// Sets the piece before the first body of the next block, with the lanes that are at their starts.
    fn set_opening(&mut self, opening: Opening<&[bool]>);
    /// Replaces the drifts that are followed. Those of the lanes in `begins` begin in the next block, which then has no
    /// steps.
    fn load_drifts(&mut self, drifts: &[DriftRows<T>], begins: Option<&[bool]>);
    /// Writes the numbers of drift `k`, now or at the beginning of the block.
    fn store_drift(&self, k: usize, when: When, rows: &mut [Vec<T>; 4]);
    /// Replaces the functions whose sign is followed, and the lanes whose observers follow signs.
    fn load_sections(&mut self, sections: &[SectionRows<T>], lanes: &[bool]);
    /// Writes the last value of function `k` and the one before, now or at the beginning of the block.
    fn store_section(&self, k: usize, when: When, rows: &mut [Vec<T>; 2]);
    /// Makes a block of steps and writes the closed states, as [`Close`](crate::ensembles::close::Close) does.
    fn block(&mut self, steps: BlockSteps<'_>, rows: &mut Vec<T>) -> BlockEnd;
    /// Writes the lanes in which all numbers were finite after the last block, and those in which H was so wherever the
    /// block evaluated it.
    fn finite(&self, numbers: &mut [bool], energies: &mut [bool]);
    /// Returns the step of mark `k` of the last block, and writes its lanes. `CarriedAt::Last` is the three states there.
    fn mark(&mut self, k: usize, lanes: &mut [bool]) -> Option<u64>;
    /// Sets `CarriedAt::Last` to the last three states of the block.
    fn take_last(&mut self);
    /// Writes the closed states at one of the last three, after a number of steps. Returns true if the duration of a step
    /// is carried.
    fn close_last(&mut self, at: usize, made: u64, rows: &mut Vec<T>) -> bool;
}

/// Carried values of all lanes.
#[derive(Debug, Clone, Copy)]
pub(super) enum CarriedAt {
    /// Those of now.
    Now,
    /// Those at the beginning of the last block.
    Before,
    /// Those after one of three consecutive steps.
    Last(usize),
}

/// The time of numbers that observers follow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum When {
    Now,
    /// The beginning of the last block.
    Before,
}

/// A drift in each lane.
pub(super) struct DriftRows<T> {
    pub(super) quantity: Quantity,
    /// The numbers of [`LaneDrift::numbers`](crate::observers::observe::LaneDrift::numbers).
    pub(super) rows: [Vec<T>; 4],
}

/// A function whose sign is followed, in each lane.
pub(super) struct SectionRows<T> {
    pub(super) function: MemberSection<T>,
    /// The value after the last step, and the one before.
    pub(super) rows: [Vec<T>; 2],
}

/// A block of steps.
pub(super) struct BlockSteps<'a> {
    /// The steps since the occupants last changed.
    pub(super) made: u64,
    pub(super) n: u64,
    /// True if the drift of H is followed.
    pub(super) energy: bool,
    /// True if any followed quantity depends on what the closing piece of a step changes.
    pub(super) closes: bool,
    pub(super) schedule: &'a Schedule,
}

/// The end of a block.
pub(super) struct BlockEnd {
    /// The number of steps made.
    pub(super) n: u64,
    /// True if the duration of a step is carried.
    pub(super) carries_duration: bool,
    /// True if all is finite in all lanes, see [`Packed::finite`].
    pub(super) is_finite: bool,
}
