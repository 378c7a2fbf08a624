//! Tables of splittings as values.
//!
//! Input: the types of core's splittings. Output: [`Weights`], a splitting whose table is a value, and the map of its flows.
//! Invariant: the numbers are those of the type.

use crate::flow::{Inside, PartFlow};
use crate::prepared::{Flat, Prepared};
use crate::system::RuntimePieces;
use hamiltonian_core::schemes::author::{Durations, Entry, Listed, Point, Splitting, Step, Zigzag};
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
