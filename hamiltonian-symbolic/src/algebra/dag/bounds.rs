//! Bounds of indices.
//!
//! Input: affine forms over the loops of the arena. Output: statements that hold in every iteration, whatever the sizes are. Invariant: a size is at least 0, and nothing more is known of it.

use super::Dag;
use crate::index::{Affine, Domain, End, Index, Loops};

impl Dag {
    /// Returns true if a loop is `i in 0..rows`.
    #[must_use]
    pub(crate) fn runs_over(&self, domain: Domain, rows: &Affine) -> bool {
        let range = self.range(domain);
        range.start == Affine::constant(0) && range.end == *rows
    }
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
    /// Returns true if an affine form is never negative, whatever the values of its loop variables in their
    /// ranges.
    #[must_use]
    pub(crate) fn is_never_negative(&self, affine: &Affine) -> bool {
        let range = |domain| {
            let range = self.range(domain);
            [&range.start, &range.end]
        };
        let least = affine.extreme(End::Least, range);
        least.is_some_and(|least| least.is_never_negative())
    }
}
