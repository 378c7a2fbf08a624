//! The runs of members in the lanes of a pack, and their host.
//!
//! Input: members, one after the other. Output: their states at stops, their ends and their failures.
//! Invariant: a run has all that is needed to continue a member in any lane, over the member's own scalar.
//! Nothing in it depends on the level, the lane or the other members.

use crate::errors::Error;
use crate::flows::map::Clock;
use crate::observers::observe::{FollowedQuantities, View};
use crate::systems::state::State;
use crate::systems::system::{Description, System, VectorOf};
use alloc::vec::Vec;
use hamiltonian_lanes::Real;

/// The run of a member, with all that is needed to continue it in any lane.
pub struct MemberRun<T: Real, S: System> {
    /// The number of the member in its host.
    pub(crate) key: usize,
    /// The prepared system.
    pub(crate) prepared: S::Prepared<T>,
    /// True if the system may differ from that of the previous run in this lane.
    pub(crate) system_changed: bool,
    /// The size of a step.
    pub(crate) step: T,
    /// The time as a function of the number of steps.
    pub(crate) clock: Clock<T>,
    /// The number of steps made.
    pub(crate) made: u64,
    /// The number of steps after which the scheme started: 0, or that of the last change of the member.
    pub(crate) began: u64,
    /// The number of steps at which the host next receives the member.
    pub(crate) stop: u64,
    /// The carried value of the scheme. It is up to date only when the member is loaded and when it leaves.
    pub(crate) words: Vec<T>,
    /// The quantities that lanes evaluate for the observer. Drifts are up to date at stops and when the member leaves.
    pub(crate) followed: FollowedQuantities<T>,
    /// The number of steps between two states that the observer receives.
    pub(crate) interval: u64,
    /// The number of steps made when the drifts were up to date.
    pub(crate) since: u64,
    /// The number of steps made when the observer last received a state, if lanes follow signs for it.
    pub(crate) received: u64,
    /// The start when the member is loaded; the state when the host receives it.
    pub(crate) state: State<VectorOf<S, T>>,
}

/// What a host may change of a run that it receives.
pub struct RunAtStop<'a, T> {
    /// The number of steps at the next stop.
    pub(crate) stop: &'a mut u64,
    /// The quantities that lanes evaluate from now on.
    pub(crate) followed: &'a mut FollowedQuantities<T>,
    /// The carried value, if the member is changed. It is not up to date before.
    pub(crate) words: &'a mut Vec<T>,
    /// The number of steps after which the scheme started: that of now, if the member is changed.
    pub(crate) began: &'a mut u64,
}

/// The owner of members, which begins their runs and receives their states at stops.
pub trait Host<T: Real, S: System> {
    /// Loads the run of the next member into a slot. A run that is already there has ended, and its storage may
    /// be reused. Returns false if there is no next member.
    fn load(&mut self, slot: &mut Option<MemberRun<T, S>>) -> bool;
    /// Receives a member's state at its stop. Returns true if the member stays, and then sets its next stop.
    fn receive(&mut self, key: usize, run: RunAtStop<'_, T>, view: &View<'_, T, S>) -> bool;
    /// Passes a state before the next stop to the observer of a member, see
    /// [`Observer::pass`](crate::Observer::pass). Returns true if the member stays.
    fn pass(&mut self, key: usize, view: &View<'_, T, S>, signs_kept: bool) -> bool;
    /// Receives the drifts of a member at its stop.
    fn take_drifts(
        &mut self,
        key: usize,
        system: &Description,
        followed: &mut FollowedQuantities<T>,
    );
    /// Returns the number of steps that followed members have made when they are loaded.
    fn phase(&self) -> u64;
    /// Receives the carried value of a member that leaves its lane.
    fn leave(&mut self, run: &mut MemberRun<T, S>);
    /// Receives a member whose next step failed. Its `words` are those before that step.
    fn fail(&mut self, run: &mut MemberRun<T, S>, error: Error);
    /// Returns true if the host receives states. Otherwise members leave at their stops.
    fn observes(&self) -> bool;
    /// Returns true if the work is cancelled. This is checked between blocks, and running members are then abandoned.
    fn is_cancelled(&mut self) -> bool;
}
