//! Sizes of forms: emitted code computes indices, ends of ranges, moduli and extents in `usize`.
//!
//! Input: affine forms. Output: a [`Reach`] for each half of a form that may be too large. Invariant: a half without one,
//! or one that its [`Reach`] passes, fits for all values of the loop variables, in whatever order emitted code adds
//! its terms.

use super::Checker;
use crate::ast::ExprId;
use crate::checked::{Bound, Extent, Reach};
use hamiltonian_symbolic::index::{Affine, End, Size, TRIED};
use hamiltonian_symbolic::ranges::Ranges;
use proc_macro2::Span;

/// The sum of as many lengths of arrays fits a `usize`: an element has at least four bytes, and an array at most
/// `isize::MAX`.
const LENGTHS: i64 = 4;

/// The largest number that is left out of account.
const SMALL: i64 = 1 << 20;

impl Checker<'_> {
    /// Records that the form must fit a `usize`, its positive and its negative terms each. `None` if they need more than
    /// 64 bits.
    pub(super) fn fits(&mut self, raw: ExprId, form: &Affine) -> Option<()> {
        let negated = form.times(-1);
        let negated = self.fitting(raw, negated)?;
        for half in [form, &negated].map(positive) {
            let greatest = self.extreme(&half, End::Greatest);
            let greatest = self.fitting(raw, greatest)?;
            self.fits_where_tried(raw, &positive(&greatest))?;
            let span = self.ast.nodes[raw.0 as usize].spans.start;
            self.fits_at(span, &positive(&greatest));
        }
        Some(())
    }

    /// Refuses a sum of positive terms over sizes that needs more than 64 bits at sizes at which the engine evaluates it.
    fn fits_where_tried(&mut self, raw: ExprId, form: &Affine) -> Option<()> {
        // The form depends on no loop.
        let value = form.checked_value(&|_| 0, &|_| TRIED);
        if value.is_none() {
            let message = format!(
                "values of this index or range need more than 64 bits for sizes of {TRIED}"
            );
            self.error_over(raw, message, "write smaller factors or shorter ranges");
        }
        value.map(|_| ())
    }

    /// Records that a sum of positive terms over sizes must fit a `usize`.
    pub(super) fn fits_at(&mut self, span: Span, form: &Affine) {
        if self.is_small(form) {
            return;
        }
        self.note(Reach {
            shown: self.affine_shown(form),
            span,
            loops: Vec::new(),
            form: form.clone(),
            limit: Bound::Memory,
        });
    }

    /// Returns true for a number, a size, and a sum of few lengths of arrays.
    fn is_small(&self, form: &Affine) -> bool {
        let is_size = form.constant == 0 && matches!(form.sizes[..], [] | [(_, 1)]);
        let mut sum = form.sizes.iter().map(|(_, factor)| factor);
        let few = form.constant <= SMALL
            && sum.try_fold(0_i64, |sum, k| sum.checked_add(*k)) <= Some(LENGTHS)
            && form.sizes.iter().all(|(size, _)| self.is_length(*size));
        form.products.is_empty() && (!form.has_sizes() || is_size || few)
    }

    /// Returns true if a size is the number of rows of an array in memory, where no other extent may be 0.
    fn is_length(&self, size: Size) -> bool {
        let parameters = self.out.parameters.iter().map(|parameter| parameter.ty);
        let mut types = parameters.chain(self.out.groups.iter().map(|group| group.ty));
        types.any(|ty| {
            let extents = ty.extents();
            let mut open = extents
                .iter()
                .filter(|extent| !matches!(extent, Extent::Literal(_)));
            open.next() == Some(&Extent::Size(size)) && open.next().is_none()
        })
    }
}

/// The positive terms of a form.
fn positive(form: &Affine) -> Affine {
    let mut half = form.clone();
    half.constant = half.constant.max(0);
    half.loops.retain(|(_, factor)| *factor > 0);
    half.sizes.retain(|(_, factor)| *factor > 0);
    half.products.retain(|(_, factor)| *factor > 0);
    half
}
