//! A group of terms that has too many subexpressions to be searched as a whole.
//!
//! Input: the group, without loops. Output: the parts of its terms in which conjugate variables meet, then those of the
//! others. Invariant: the flows of the others move everything at a constant rate and need no search, however long the
//! terms are.

use super::join::keep_invariants;
use super::{NoFlow, Parts, Reasons, searched, units};
use crate::dag::Node;
use crate::flows::limits::{Limit, is_large};
use crate::flows::solve::constant_rates;
use crate::flows::space::{Space, Variables};
use crate::model::Model;
use crate::sort::Arrange;

/// The parts of a group.
///
/// # Errors
/// [`NoFlow`] with a term in which conjugate variables meet: there are too many subexpressions in such terms too, or no
/// form takes it.
pub(super) fn parts(model: &mut Model, group: Node) -> Result<Parts, NoFlow> {
    let terms = units::terms(&mut model.dag, group);
    let first = terms.first().map_or(group, |term| term.body);
    let mut space = space(model, group, first)?;
    let (mut coupled, mut others) = (Vec::new(), Vec::new());
    for term in terms {
        let set = space.set(term.body);
        match set.whole_pairs().is_empty() {
            true => others.push((term.body, set)),
            false => coupled.push(term.body),
        }
    }
    // Momenta first, then coordinates.
    others.arrange_by_key(|(_, set)| {
        let (coordinates, momenta) = set.sides();
        (coordinates && momenta, coordinates)
    });
    let mut sums: Vec<(Vec<Node>, Variables)> = Vec::new();
    for (term, set) in others {
        let fits = |sum: &&mut (_, Variables)| (sum.1 | set).whole_pairs().is_empty();
        match sums.iter_mut().find(fits) {
            Some((terms, known)) => {
                terms.push(term);
                *known |= set;
            }
            None => sums.push((vec![term], set)),
        }
    }
    let mut flows = Vec::with_capacity(sums.len());
    for (terms, _) in sums {
        let part = space.dag().add(&terms);
        let c = space.dag().coefficient();
        flows.push((part, constant_rates(&mut space, part, c)));
    }
    model.dag = space.model.dag;
    let mut parts = Parts::default();
    if let Some(&first) = coupled.first() {
        let sum = model.dag.add(&coupled);
        if is_large(&model.dag, sum) {
            return Err(NoFlow::of(model, first, Some(Limit::Subexpressions)));
        }
        let mut space = self::space(model, sum, first)?;
        parts = searched(model, &mut space, sum)?;
    }
    parts.flows.extend(flows);
    let among = parts.choice.map_or(1, |choice| choice.among);
    // No run of all of the group was followed; one flow has no error.
    parts.choice = (parts.flows.len() > 1).then(|| Reasons {
        error: f64::NAN,
        among,
        keeps_invariants: keep_invariants(model, group, &parts.flows),
    });
    Ok(parts)
}

/// The space of a sum; the first of its terms stands for it in messages.
fn space(model: &Model, sum: Node, first: Node) -> Result<Space, NoFlow> {
    Space::new(model, &[sum]).map_err(|limit| NoFlow::of(model, first, limit))
}
