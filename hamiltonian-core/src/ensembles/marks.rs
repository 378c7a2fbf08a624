//! Steps of lanes whose states are passed to observers of signs.
//!
//! Input: the carried values of the lanes, step by step. Output: the marked steps, with the carried values
//! after them and after the two steps before. Invariant: the lanes continue past a marked step. Observers
//! receive its state at the end of the block, and may then end their member at the marked step.
//!
//! # Example: a block with a marked step
//! Four pendulums in four lanes, each with an event at the angle 0, make a block of 1024 steps. In step 310 the angle of
//! lane 2 changes its sign.
//!
//! 1. The block writes the carried values of each step into the ring. After step 310, `to_mark` is {2}: `mark(310)` stores
//!    (310, {2}) and the values after the steps 308, 309 and 310. No lane stops.
//! 2. The block ends after step 1024, or earlier at its sixteenth mark.
//! 3. Lane 2 is closed at the three marked values, over `f64`. Its observer passes the states 308 and 309, in whose steps no
//!    sign changed, and then 310. It locates the event between the last two.
//! 4. If the event ends the member, the run of lane 2 ends in step 310. Its steps 311 to 1024 are dropped, and the lane is
//!    refilled. The other lanes go on from step 1024.

use crate::systems::vector::Vector;
use alloc::vec::Vec;
use hamiltonian_lanes::Mask;

/// The number of marked steps after which a block ends.
const MAX_MARKED: usize = 16;

/// The carried values after three consecutive steps, the last one last.
pub(crate) type LastThree<C> = [C; 3];

/// The marks of a block.
pub(crate) struct Marks<C, M> {
    /// The carried values after the last three steps, as a ring buffer.
    ring: LastThree<C>,
    /// The index of the newest value in the ring.
    newest: usize,
    /// The lanes in which the current step will be marked.
    pub(crate) to_mark: M,
    /// The marked steps, and the lanes for which they are marked.
    pub(crate) steps: Vec<(u64, M)>,
    /// The carried values at the marks. The vector is never shortened, so that its storage is reused.
    states: Vec<LastThree<C>>,
}

impl<C: Vector, M: Mask> Marks<C, M> {
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(crate) fn new(ring: LastThree<C>) -> Self {
        Marks {
            ring,
            newest: 0,
            to_mark: M::splat(false),
            steps: Vec::new(),
            states: Vec::new(),
        }
    }

    /// Replaces the last carried value after a refill of lanes.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(crate) fn replace(&mut self, carried: &C) {
        self.ring[self.newest].copy_from(carried);
    }

    /// Adds the carried value after a step.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(crate) fn add(&mut self, carried: &C) {
        self.newest = if self.newest == 2 { 0 } else { self.newest + 1 };
        self.ring[self.newest].copy_from(carried);
    }

    /// Returns the carried value that was added last.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(crate) fn newest(&self) -> &C {
        &self.ring[self.newest]
    }

    /// Copies the last three carried values, in order.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(crate) fn copy_last(&self, to: &mut LastThree<C>) {
        for (ahead, to) in (1..).zip(to) {
            to.copy_from(&self.ring[(self.newest + ahead) % 3]);
        }
    }

    /// Marks the last step for the lanes in `to_mark`. Returns true if the block should end.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(crate) fn mark(&mut self, step: u64) -> bool {
        let lanes = core::mem::replace(&mut self.to_mark, M::splat(false));
        let mark = self.steps.len();
        if mark == self.states.len() {
            self.states.push(self.ring.clone());
        }
        for (ahead, to) in (1..).zip(&mut self.states[mark]) {
            to.copy_from(&self.ring[(self.newest + ahead) % 3]);
        }
        self.steps.push((step, lanes));
        self.steps.len() >= MAX_MARKED
    }

    /// Returns the carried values at a mark.
    #[cfg_attr(not(unoptimised), inline(always))]
    pub(crate) fn states(&self, mark: usize) -> &LastThree<C> {
        &self.states[mark]
    }
}
