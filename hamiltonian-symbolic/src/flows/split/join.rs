//! Terms of H that have no degree of freedom in common are split apart, so that none has an effect on the
//! pieces of another. Their flows commute.
//!
//! Input: H, and the parts of each of its groups of terms. Output: parts of H. Invariant: a joined part is
//! the sum of parts of different groups, and its flow is theirs, one after the other.

use super::{Parts, Reasons, any_flow, units};
use crate::dag::{Dag, Dependence, Kind, Node};
use crate::flows::space::Space;
use crate::list::IntoList;
use crate::model::Model;
use crate::model::{EXPONENTIAL, NamedMotion};
use crate::sort::Arrange;
use crate::structure::components;

/// The groups of terms that have no degree of freedom in common, each as a sum.
pub(super) fn groups(model: &mut Model, h: Node) -> Vec<Node> {
    if has_loops(&model.dag, h) {
        return vec![h];
    }
    let mut dag = model.dag.clone();
    let terms = units::terms(&mut dag, h);
    let terms: Vec<Node> = terms.into_iter().map(|term| term.body).into_list();
    let groups = components(&dag, &terms);
    if groups.len() < 2 {
        return vec![h];
    }
    model.dag = dag;
    groups.iter().map(|group| model.dag.add(group)).into_list()
}

/// Returns true if an expression has loops, or numbers of their iterations.
pub(super) fn has_loops(dag: &Dag, h: Node) -> bool {
    dag.has(&[h], &|kind| {
        matches!(kind, Kind::Reduce(..) | Kind::Count(_) | Kind::Variable(_))
    })
}

/// The flow of a sum of expressions that have nothing in common; `None` where one has no motion in closed
/// form.
pub(super) fn flows(dag: &mut Dag, flows: &[NamedMotion]) -> Option<NamedMotion> {
    let mut all = NamedMotion::default();
    for flow in flows {
        if flow.forms == [EXPONENTIAL] {
            return None;
        }
        all = all.noted(&flow.forms);
        all.motion = all.motion.then(dag, &flow.motion);
    }
    Some(all)
}

/// The parts of all groups as few parts, innermost with innermost; in another order where kicks would not be
/// joined with kicks. The groups come in an order that follows from H alone.
pub(super) fn parts(model: &mut Model, h: Node, mut groups: Vec<Parts>) -> Parts {
    let choice = choice(&groups);
    // Groups with equally many parts keep their order.
    groups.arrange_by_key(|group| std::cmp::Reverse(group.flows.len()));
    let written = units::terms(&mut model.dag, h);
    let written: Vec<Node> = written.into_iter().map(|term| term.body).into_list();
    let mut all: Vec<(Node, NamedMotion)> = Vec::new();
    for mut group in groups {
        if all.is_empty() {
            all = group.flows;
            continue;
        }
        let (at, is_reversed) = best_place(&model.dag, &all, &group.flows);
        if is_reversed {
            group.flows.reverse();
        }
        for (k, (node, flow)) in group.flows.into_iter().enumerate() {
            let (known, own) = &mut all[at + k];
            let sum = sum(&mut model.dag, &written, [*known, node]);
            match flows(&mut model.dag, &[own.clone(), flow.clone()])
                .or_else(|| flow_of_sum(model, sum))
            {
                Some(joined) => (*known, *own) = (sum, joined),
                None => all.push((node, flow)),
            }
        }
    }
    let choice = choice.map(|choice| Reasons {
        keeps_invariants: keep_invariants(model, h, &all),
        ..choice
    });
    Parts { flows: all, choice }
}

/// The terms of two parts in the order in which they are written in H.
fn sum(dag: &mut Dag, written: &[Node], parts: [Node; 2]) -> Node {
    let mut terms: Vec<Node> = Vec::new();
    for part in parts {
        match dag.kind(part).clone() {
            Kind::Sum(c, sum) => {
                terms.extend(sum.iter().map(|(k, term)| dag.scale(k, *term)));
                terms.extend((!c.is_zero()).then(|| dag.constant(c)));
            }
            _ => terms.push(part),
        }
    }
    let place = |term: &Node| written.iter().position(|other| other == term);
    terms.arrange_by_key(|term| place(term).unwrap_or(usize::MAX));
    dag.add(&terms)
}

/// The place from which fewest kicks meet other parts, and whether in reverse; the innermost of several.
fn best_place(
    dag: &Dag,
    all: &[(Node, NamedMotion)],
    group: &[(Node, NamedMotion)],
) -> (usize, bool) {
    let sides = |(node, _): &(Node, NamedMotion)| {
        let dependence = dag.dependence(*node);
        (dependence.on(Dependence::Q), dependence.on(Dependence::P))
    };
    let own: Vec<(bool, bool)> = group.iter().map(sides).into_list();
    // How many kicks meet other parts, and how many parts of other sides meet.
    let mixed = |(at, is_reversed): &(usize, bool)| {
        let parts = all[*at..].iter().take(group.len()).map(sides);
        let (mut kicks, mut others) = (0, 0);
        for (k, (q, p)) in parts.enumerate() {
            let of = match is_reversed {
                true => own[group.len() - 1 - k],
                false => own[k],
            };
            kicks += usize::from(p != of.1);
            others += usize::from((q, p) != of);
        }
        (kicks, others)
    };
    let places = (0..=all.len() - group.len()).rev();
    let both = [false, true].into_iter();
    let ways = both.flat_map(|is_reversed| places.clone().map(move |at| (at, is_reversed)));
    ways.min_by_key(mixed).unwrap_or((0, false))
}

/// The flow of a sum that is a quadratic form over the whole point.
fn flow_of_sum(model: &mut Model, sum: Node) -> Option<NamedMotion> {
    let mut space = Space::new(model, &[sum]).ok()?;
    let flow = any_flow(&mut space, sum)?;
    model.dag = space.model.dag;
    Some(flow)
}

/// The reasons of all groups: errors of H add up.
fn choice(groups: &[Parts]) -> Option<Reasons> {
    let mut all: Option<Reasons> = None;
    for reasons in groups.iter().filter_map(|group| group.choice.as_ref()) {
        let known = all.get_or_insert(Reasons {
            error: 0.0,
            among: 0,
            keeps_invariants: false,
        });
        known.error += reasons.error;
        known.among += reasons.among;
    }
    all
}

/// Returns true if each part keeps each declared invariant.
pub(super) fn keep_invariants(model: &mut Model, h: Node, parts: &[(Node, NamedMotion)]) -> bool {
    let invariants = model.invariants();
    let Ok(mut space) = Space::new(model, &[h]) else {
        return false;
    };
    !invariants.is_empty()
        && parts
            .iter()
            .all(|(part, _)| invariants.iter().all(|of| space.is_kept(*of, *part)))
}
