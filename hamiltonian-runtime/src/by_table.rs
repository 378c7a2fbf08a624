//! Splittings whose table is a value.
//!
//! Input: the tables of core's splittings. Output: [`ByTable`], one scheme for all of them. Invariant: a step applies the
//! same flows in the same order as the scheme of the type, so the bits are the same; the map is compiled once.

use crate::in_frame::InFrameMap;
use crate::prepared::{Flat, Prepared};
use crate::system::{RuntimePieces, RuntimeSystem};
use crate::weights::{Flows, Weights};
use hamiltonian_core::schemes::author::{
    Description, Dynamics, Entry, Listed, Point, Splitting, Step,
};
use hamiltonian_core::{Scheme, State};
use hamiltonian_lanes::Real;
use std::fmt::{self, Debug, Formatter};

/// The pieces that a splitting moves, the outermost first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Moves {
    /// The pieces of H.
    Pieces,
    /// T, then V.
    Drift,
    /// V or T, then the other: a piece that jumps in time is not the first.
    KickUnlessItJumps,
    /// T or V, likewise.
    DriftUnlessItJumps,
    /// V, then the piece at most quadratic in the momenta.
    NystromKick,
    /// That piece, then V.
    NystromDrift,
}

impl Moves {
    /// The pieces of a system, and whether they jump in time: the first one, and the others.
    fn on(self, system: &Description) -> (RuntimePieces, [bool; 2]) {
        let [kick, drift] = system.jumps;
        let kick_first = (RuntimePieces::Kick, [kick, drift]);
        let drift_first = (RuntimePieces::Drift, [drift, kick]);
        match (self, system.jumps) {
            (Moves::Pieces, _) => (RuntimePieces::All, system.jumping_pieces()),
            (Moves::KickUnlessItJumps, [true, false]) => drift_first,
            (Moves::DriftUnlessItJumps, [false, true]) => kick_first,
            (Moves::KickUnlessItJumps, _) => kick_first,
            (Moves::Drift | Moves::DriftUnlessItJumps, _) => drift_first,
            (Moves::NystromKick, _) => (RuntimePieces::NystromKick, [kick, drift]),
            (Moves::NystromDrift, _) => (RuntimePieces::NystromDrift, [drift, kick]),
        }
    }
}

/// The scheme of a table.
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct ByTable {
    pub(crate) weights: Weights,
    pub(crate) moves: Moves,
}

impl Debug for ByTable {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.weights.fmt(f)
    }
}

impl Listed for ByTable {
    fn entry(&self) -> Entry {
        self.weights.entry()
    }
}

impl Scheme<RuntimeSystem> for ByTable {
    type Carried = Point<<RuntimeSystem as hamiltonian_core::System>::Shape>;
    type Map<T: Real> = InFrameMap<Flows<T>, T>;

    fn times_of_jumps(&self, of: &Description) -> [f64; 2] {
        self.weights.times_on(self.moves.on(of).1)
    }

    fn prepare<T: Real>(&self, prepared: &Prepared<T>, step: Step<T>) -> Self::Map<T> {
        let (pieces, _) = self.moves.on(prepared.description());
        InFrameMap::of(self.weights.flows(&pieces, prepared, step))
    }

    fn start<T: Real>(&self, _: &Prepared<T>, state: &State<Flat<T>>, _: T) -> Point<Flat<T>> {
        state.point()
    }
}
