//! A group of terms that has too many subexpressions to be searched as a whole.
//!
//! Input: the group, without loops. Output: the parts of its terms in which coordinates and momenta meet, then T and V.
//! Invariant: T and V are the terms of momenta and of coordinates alone, whose flows need no search, however long they
//! are.

use super::sweep::side;
use super::{NoFlow, Parts, searched, units};
use crate::dag::{Node, Side};
use crate::flows::limits::{Limit, is_large};
use crate::flows::solve::constant_rates;
use crate::flows::space::Space;
use crate::model::Model;

/// The parts of a group.
///
/// # Errors
/// [`NoFlow`] with a term in which coordinates and momenta meet: there are too many subexpressions in such terms too, or
/// no row takes it.
pub(super) fn parts(model: &mut Model, group: Node) -> Result<Parts, NoFlow> {
    let (mut mixed, mut sides) = (Vec::new(), [Vec::new(), Vec::new()]);
    for term in units::terms(&mut model.dag, group) {
        match side(&model.dag, term.body) {
            Some(side) => sides[usize::from(side == Side::Q)].push(term.body),
            None => mixed.push(term.body),
        }
    }
    let mut parts = Parts::default();
    if let Some(&first) = mixed.first() {
        let sum = model.dag.add(&mixed);
        if is_large(&model.dag, sum) {
            return Err(NoFlow::of(model, first, Some(Limit::Subexpressions)));
        }
        let mut space = space(model, sum, first)?;
        parts = searched(model, &mut space, sum)?;
    }
    for terms in sides {
        let Some(&first) = terms.first() else {
            continue;
        };
        let part = model.dag.add(&terms);
        let mut space = space(model, part, first)?;
        let c = space.dag().coefficient();
        let flow = constant_rates(&mut space, part, c);
        model.dag = space.model.dag;
        parts.flows.push((part, flow));
    }
    Ok(parts)
}

/// The space of a sum; the first of its terms stands for it in messages.
fn space(model: &Model, sum: Node, first: Node) -> Result<Space, NoFlow> {
    Space::new(model, &[sum]).map_err(|limit| NoFlow::of(model, first, limit))
}
