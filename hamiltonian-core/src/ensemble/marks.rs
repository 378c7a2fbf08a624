//! Steps of lanes that observers of signs must see.
//!
//! Input: what lanes carry, step by step. Output: the steps that are marked, with what was carried then and
//! after the two steps before. Invariant: the lanes go on past a marked step, so what a member has made of
//! it, even its end, is known at the end of the block.

use crate::vector::Vector;
use alloc::vec::Vec;
use hamiltonian_lanes::Mask;

/// As many marked steps end a block.
const MOST: usize = 16;

/// The values carried after three steps, the last one last.
pub(crate) type Three<C> = [C; 3];

/// The marks of a block.
pub(crate) struct Marks<C, M> {
    /// The values carried after the last three steps.
    ring: Three<C>,
    /// The place of the last of them.
    turn: usize,
    /// The lanes for which the present step is to be marked.
    pub(crate) loud: M,
    /// The steps that are marked, and their lanes.
    pub(crate) steps: Vec<(u64, M)>,
    /// What was carried then. There are as many as have ever been of use.
    states: Vec<Three<C>>,
}

impl<C: Vector, M: Mask> Marks<C, M> {
    #[inline(always)]
    pub(crate) fn new(ring: Three<C>) -> Self {
        Marks {
            ring,
            turn: 0,
            loud: M::splat(false),
            steps: Vec::new(),
            states: Vec::new(),
        }
    }

    /// Replaces the last carried value: some lanes have new members.
    #[inline(always)]
    pub(crate) fn replace(&mut self, carried: &C) {
        self.ring[self.turn].copy_from(carried);
    }

    /// Adds what is carried after a step.
    #[inline(always)]
    pub(crate) fn add(&mut self, carried: &C) {
        self.turn = if self.turn == 2 { 0 } else { self.turn + 1 };
        self.ring[self.turn].copy_from(carried);
    }

    /// What was added last.
    #[inline(always)]
    pub(crate) fn present(&self) -> &C {
        &self.ring[self.turn]
    }

    /// The last three.
    #[inline(always)]
    pub(crate) fn last(&self, to: &mut Three<C>) {
        for (ahead, to) in (1..).zip(to) {
            to.copy_from(&self.ring[(self.turn + ahead) % 3]);
        }
    }

    /// Marks the last step for the lanes that are loud. Returns true if the block should end.
    #[inline(always)]
    pub(crate) fn mark(&mut self, step: u64) -> bool {
        let lanes = core::mem::replace(&mut self.loud, M::splat(false));
        let place = self.steps.len();
        if place == self.states.len() {
            self.states.push(self.ring.clone());
        }
        for (ahead, to) in (1..).zip(&mut self.states[place]) {
            to.copy_from(&self.ring[(self.turn + ahead) % 3]);
        }
        self.steps.push((step, lanes));
        self.steps.len() >= MOST
    }

    /// What was carried at a mark.
    #[inline(always)]
    pub(crate) fn states(&self, mark: usize) -> &Three<C> {
        &self.states[mark]
    }
}
