//! Splittings whose table is a value.
//!
//! Input: the types of core's splittings. Output: [`ByTable`], one scheme for all of them, and [`Tables`] for schemes that
//! take a splitting. Invariant: a step applies the same flows in the same order as the scheme of the type, so the bits are
//! the same; the map is compiled once.

use crate::flow::{Inside, PartFlow};
use crate::in_frame::InFrameMap;
use crate::prepared::{Flat, Prepared};
use crate::system::{RuntimePieces, RuntimeSystem};
use hamiltonian_core::schemes::author::{
    Description, Durations, Dynamics, Entry, Listed, Point, Splitting, Step, Zigzag,
};
use hamiltonian_core::{Scheme, State};
use hamiltonian_lanes::Real;
use std::fmt::{self, Debug, Formatter};

/// The weights of a splitting, with the entry of the scheme that it is the table of.
#[derive(Clone, PartialEq)]
pub(crate) struct Table {
    entry: Entry,
    /// The `Debug` text of the scheme, by which a saved run is recognised.
    text: String,
    stages: Vec<Durations>,
}

impl Table {
    /// True if the table is one for any H, not for one with a small piece.
    pub(crate) fn is_general(&self) -> bool {
        !["Saba", "Aba"]
            .iter()
            .any(|name| self.entry.name.starts_with(name))
    }

    pub(crate) fn of<W: Splitting>(scheme: &W) -> Table {
        Table {
            entry: scheme.entry(),
            text: format!("{scheme:?}"),
            stages: scheme.stages().as_ref().to_vec(),
        }
    }
}

/// The table of the second, with the entry and the text of the first.
#[derive(Clone, Copy)]
pub(crate) struct Named<M, W>(pub(crate) M, pub(crate) W);

impl<M: Listed, W: Splitting> Debug for Named<M, W> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl<M: Listed + Copy, W: Splitting> Listed for Named<M, W> {
    fn entry(&self) -> Entry {
        self.0.entry()
    }
}

impl<M: Listed + Copy, W: Splitting> Splitting for Named<M, W> {
    type Of<U> = W::Of<U>;
    fn stages(&self) -> W::Of<Durations> {
        self.1.stages()
    }
    fn filled<U: Clone>(&self, value: U) -> W::Of<U> {
        self.1.filled(value)
    }
}

/// A table that is never freed, so that it is copied as a reference.
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Weights(pub(crate) &'static Table);

/// The flows of a table for a step.
pub(crate) type Flows<T> = Zigzag<Point<Flat<T>>, PartFlow<T>, Inside<T>, Weights>;

impl Weights {
    /// The flows on these pieces.
    #[inline(always)]
    pub(crate) fn flows<T: Real>(
        &self,
        pieces: &RuntimePieces,
        prepared: &Prepared<T>,
        step: Step<T>,
    ) -> Flows<T> {
        Zigzag::new(self, pieces, prepared, step)
    }
}

impl Debug for Weights {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.text)
    }
}

impl Listed for Weights {
    fn entry(&self) -> Entry {
        self.0.entry
    }
}

impl Splitting for Weights {
    type Of<U> = Vec<U>;
    fn stages(&self) -> Vec<Durations> {
        self.0.stages.clone()
    }
    fn filled<U: Clone>(&self, value: U) -> Vec<U> {
        vec![value; self.0.stages.len()]
    }
}

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
