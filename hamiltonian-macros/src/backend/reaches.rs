//! Questions that only sizes decide, as numbers.
//!
//! Input: [`Checked`]. Output: forms over the sizes and loops they mention. Invariant: the loops of
//! a form are all that its loops' ranges mention.

use crate::checked::{self, Affine, Checked, Extent, IndexVariable, LoopId, SizeId};
use crate::emit::{Bound, Reach};

/// Everything emitted code has to ask.
pub fn reaches(checked: &Checked) -> Vec<Reach> {
    let one = |reach| numbers(checked, reach);
    checked.reaches.iter().map(one).collect()
}

fn numbers(checked: &Checked, reach: &checked::Reach) -> Reach {
    let ranges = reach.loops.iter().map(|id| {
        let range = &checked.loops[id.0 as usize];
        [&range.lower, &range.upper]
    });
    let ranges: Vec<_> = ranges.collect();
    let mut sizes: Vec<SizeId> = Vec::new();
    for form in ranges.iter().flatten().copied().chain([&reach.form]) {
        sizes.extend(
            form.terms
                .iter()
                .filter_map(|(variable, _)| match variable {
                    IndexVariable::Size(size) => Some(*size),
                    IndexVariable::Loop(_) => None,
                }),
        );
    }
    sizes.sort_unstable();
    sizes.dedup();
    let outside = |level: usize| &reach.loops[..level];
    let loops = ranges
        .iter()
        .enumerate()
        .map(|(level, range)| range.map(|form| factors(form, &sizes, outside(level))));
    Reach {
        shown: reach.shown.clone(),
        span: reach.span,
        loops: loops.collect(),
        form: factors(&reach.form, &sizes, &reach.loops),
        sizes: sizes.into_iter().map(|size| size.0 as usize).collect(),
        extent: reach.extent.map(|extent| match extent {
            Extent::Literal(value) => Bound::Literal(value),
            Extent::Size(size) => Bound::Size(size.0 as usize),
        }),
    }
}

/// `[constant, factor of each size…, factor of each loop…]`
fn factors(form: &Affine, sizes: &[SizeId], loops: &[LoopId]) -> Vec<i64> {
    let factor = |wanted: IndexVariable| {
        let term = form.terms.iter().find(|(variable, _)| *variable == wanted);
        term.map_or(0, |(_, factor)| *factor)
    };
    let sizes = sizes.iter().map(|size| factor(IndexVariable::Size(*size)));
    let loops = loops.iter().map(|id| factor(IndexVariable::Loop(*id)));
    [form.constant]
        .into_iter()
        .chain(sizes)
        .chain(loops)
        .collect()
}
