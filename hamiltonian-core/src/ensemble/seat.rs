//! Members in the lanes of a pack, and their host.
//!
//! Input: members, one after the other. Output: their arrivals, their ends, their failures. Invariant: a
//! seat holds all that makes a member go on, over its own scalar: nothing in it depends on the level, the
//! lane or the neighbours.

use crate::error::Error;
use crate::map::Clock;
use crate::observe::{Follows, View};
use crate::state::State;
use crate::system::System;
use alloc::vec::Vec;
use hamiltonian_lanes::Real;

/// A member on its way.
pub struct Seat<T: Real, S: System<T>> {
    /// The host's number of the member.
    pub(crate) key: usize,
    /// Its system.
    pub(crate) prepared: S::Prepared,
    /// True if the system is another one than the one before in this seat.
    pub(crate) other: bool,
    /// Its step.
    pub(crate) step: T,
    /// Its time.
    pub(crate) clock: Clock<T>,
    /// The number of steps made.
    pub(crate) made: u64,
    /// The number of steps at which the host sees it next.
    pub(crate) stop: u64,
    /// All that the scheme carries: on loading, and when it leaves.
    pub(crate) words: Vec<T>,
    /// All that lanes follow for its observer. Drifts are up to date when it leaves and at its stops.
    pub(crate) follows: Follows<T>,
    /// The number of steps between two states whose drift it follows.
    pub(crate) interval: u64,
    /// The number of steps made when the drifts were up to date.
    pub(crate) since: u64,
    /// The number of steps made when its observer last saw a state, if lanes follow signs for it.
    pub(crate) seen: u64,
    /// The start on loading; the state on arrival.
    pub(crate) state: State<S::Vector>,
}

/// The owner of members, which seats them and sees them at their stops.
pub trait Host<T: Real, S: System<T>> {
    /// Puts the next member into a seat, which may hold one that has left. Returns false if there is none.
    fn load(&mut self, seat: &mut Option<Seat<T, S>>) -> bool;
    /// Receives a member's state at its stop. Returns true if the member stays, with its stop moved on. Lanes
    /// follow from now on what is in `follows`.
    fn arrive(
        &mut self,
        key: usize,
        stop: &mut u64,
        follows: &mut Follows<T>,
        view: &View<'_, T, S>,
    ) -> bool;
    /// Shows the observer of a member a state on the way to its stop, see
    /// [`Observer::pass`](crate::Observer::pass). Returns true if the member goes on.
    fn pass(&mut self, key: usize, view: &View<'_, T, S>, quiet: bool) -> bool;
    /// Takes the drifts of a member at its stop.
    fn follow(&mut self, key: usize, follows: &mut Follows<T>);
    /// The number of steps that members which are followed have made when they are loaded.
    fn phase(&self) -> u64;
    /// Takes back what a member carries when it leaves.
    fn leave(&mut self, seat: &mut Seat<T, S>);
    /// Takes back a member whose next step failed; `words` are those before that step.
    fn fail(&mut self, seat: &mut Seat<T, S>, error: Error);
    /// Returns true if it receives states; if not, members leave at their stops.
    fn looks(&self) -> bool;
    /// Returns true if the work stops here, between two blocks: members under way are left where they are.
    fn is_cancelled(&mut self) -> bool;
}
