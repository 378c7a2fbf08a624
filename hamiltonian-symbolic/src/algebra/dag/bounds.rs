//! The loops of a dag as ranges: what holds in every iteration, and which loops visit the rows of an array.
//!
//! Input: indices and affine forms. Output: the statements of [`Ranges`] for the loops of a dag. Invariant: as there.

use super::Dag;
use crate::index::{Affine, Domain, Index, Loops};
use crate::ranges::Ranges;

impl Ranges for Dag {
    fn bounds(&self, domain: Domain) -> [&Affine; 2] {
        let range = self.range(domain);
        [&range.start, &range.end]
    }

    fn rooms(&self) -> &[Affine] {
        &self.rooms
    }
}

impl Dag {
    /// The loops whose iterations are the rows, each one once: that of `i` alone in
    /// `0..rows`, or those of `i`, `j`, … for an index of several axes, with no loop around them.
    #[must_use]
    pub(crate) fn loops_of_rows(&self, row: &Index, rows: &Affine) -> Option<Loops> {
        let (mut loops, mut total) = (Loops::default(), Affine::constant(1));
        let mut innermost = None;
        for axis in row.axes() {
            let domain = axis.as_loop()?;
            let range = self.range(domain);
            let is_new = !loops.has(domain);
            if !(is_new && range.start == Affine::constant(0)) {
                return None;
            }
            loops |= Loops::of(domain);
            total = total.checked_times(&range.end)?;
            innermost = self.deepest(loops);
        }
        let mut around = self.path(innermost).into_iter();
        let is_alone = around.all(|domain| loops.has(domain));
        (is_alone && self.fill_axes(row) && total == *rows).then_some(loops)
    }
    /// Returns true if the loop of each axis but the first runs over its extent.
    fn fill_axes(&self, row: &Index) -> bool {
        let Some(outer) = &row.outer else {
            return true;
        };
        let runs = |(domain, _): &(Domain, i64)| self.runs_over(*domain, &outer.extent);
        row.affine.loops.iter().all(runs) && self.fill_axes(&outer.index)
    }
    /// `i % N` for i in 0..N is `i`.
    pub(crate) fn unwrapped(&self, index: Index) -> Index {
        let plain = index.try_map(&mut |axis| {
            let is_bare = |&(domain, _): &(Domain, i64)| {
                self.rotation(axis, domain) == Some(Affine::default())
            };
            let affine = axis.affine.clone();
            Some(match axis.affine.loops.first().is_some_and(is_bare) {
                true => Index::plain(affine),
                false => axis.clone(),
            })
        });
        plain.unwrap_or(index)
    }
}
