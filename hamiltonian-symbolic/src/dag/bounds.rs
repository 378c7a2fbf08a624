//! Bounds of indices and of values.
//!
//! Input: affine forms over the loops of the arena, signs of factors. Output: statements that hold
//! in every iteration, whatever the sizes are. Invariant: a size is at least 0, and nothing more is known of it.

use super::Dag;
use crate::index::{Affine, Domain, End, Index};
use crate::op::Range;

impl Dag {
    /// Whether a loop is `i in 0..rows`.
    #[must_use]
    pub(crate) fn runs_over(&self, domain: Domain, rows: &Affine) -> bool {
        let range = self.range(domain);
        range.start == Affine::constant(0) && range.end == *rows
    }
    /// The loop whose iterations are the rows, each one once: that of `i` alone in `0..rows`, with no
    /// loop around it.
    #[must_use]
    pub(crate) fn loop_of_rows(&self, row: &Index, rows: &Affine) -> Option<Domain> {
        let [(domain, 1)] = *row.affine.loops.as_slice() else {
            return None;
        };
        let is_plain = *row == Index::plain(Affine::variable(domain));
        let is_outermost = self.range(domain).parent.is_none();
        (is_plain && is_outermost && self.runs_over(domain, rows)).then_some(domain)
    }
    /// Whether an affine form is never negative, whatever the values of its loop variables in their
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

/// Whether a product of powers is ≥ 0, of which is said whether each factor is.
pub(crate) fn is_nonnegative_product(mut factors: impl Iterator<Item = (bool, i32)>) -> bool {
    factors.all(|(is_nonnegative, n)| n % 2 == 0 || is_nonnegative)
}

/// Whether values of a function are ≥ 0, of whose first argument is said whether it is.
pub(crate) fn is_nonnegative_call(range: Range, first: bool) -> bool {
    match range {
        Range::Any => false,
        Range::NonNegative | Range::Positive => true,
        Range::OfBase => first,
    }
}
