//! H = T(p, t) + V(q, t), or the term that forbids it.
//!
//! Input: a model and its H. Output: [`Split`] or [`Coupling`]. Invariant: term by term first,
//! which keeps the source's grouping; multiplied out only where that fails; relations between
//! functions (sin² + cos² = 1) only where numbers do not already show that H is not separable.

use super::{Coupling, Split, expand};
use crate::dag::{Dag, Dependence, Kind, Map, Node};
use crate::loops::{Sample, sample};
use crate::model::Model;
use crate::normal_form;
use crate::print;
use crate::rational::Rational;

const BOTH: Dependence = Dependence(Dependence::Q.0 | Dependence::P.0);

fn couples(dag: &Dag, node: Node) -> bool {
    let dependence = dag.dependence(node);
    dependence.on(Dependence::Q) && dependence.on(Dependence::P)
}

/// The split of H, or the first coupling term.
pub(super) fn split(model: &mut Model, h: Node) -> Result<Split, Coupling> {
    if let Some(split) = term_by_term(&mut model.dag, h) {
        return Ok(split);
    }
    let mut nodes = Vec::new();
    match expand(&mut model.dag, h) {
        Some(terms) => terms
            .iter()
            .for_each(|term| nodes.push(term.node(&mut model.dag))),
        None => nodes.push(h),
    }
    let mut kinetic = Vec::new();
    let mut potential = Vec::new();
    let mut coupling = None;
    for node in nodes {
        // A term may be a sum again inside a loop or an `if`.
        match term_by_term(&mut model.dag, node) {
            Some(split) => {
                kinetic.push(split.kinetic);
                potential.push(split.potential);
            }
            None => {
                coupling = Some(node);
                break;
            }
        }
    }
    let Some(term) = coupling else {
        return Ok(Split {
            kinetic: model.dag.add(&kinetic),
            potential: model.dag.add(&potential),
        });
    };
    if !is_certainly_coupled(model, h)
        && let Some((kinetic, potential)) = normal_form::separated(model, h)
    {
        return Ok(Split { kinetic, potential });
    }
    Err(Coupling {
        term,
        text: print::text(model, term),
    })
}

/// The split of a node whose own sums separate it.
fn term_by_term(dag: &mut Dag, root: Node) -> Option<Split> {
    let zero = dag.integer(0);
    let one_sided = |dag: &Dag, node: Node| {
        if dag.dependence(node).on(Dependence::P) {
            Split {
                kinetic: node,
                potential: zero,
            }
        } else {
            Split {
                kinetic: zero,
                potential: node,
            }
        }
    };
    let mut splits: Map<Node, Split> = Map::default();
    for node in spine(dag, root) {
        if !couples(dag, node) {
            splits.insert(node, one_sided(dag, node));
            continue;
        }
        let part = |split: &Split, kinetic: bool| {
            if kinetic {
                split.kinetic
            } else {
                split.potential
            }
        };
        let split = match dag.kind(node).clone() {
            Kind::Sum(c, terms) => {
                let mut sides = [zero; 2];
                for (side, kinetic) in sides.iter_mut().zip([true, false]) {
                    let mut operands = Vec::with_capacity(terms.len());
                    for (k, child) in &terms {
                        operands.push((k.clone(), part(splits.get(child)?, kinetic)));
                    }
                    *side = dag.linear(if kinetic { &Rational::ZERO } else { &c }, &operands);
                }
                Split {
                    kinetic: sides[0],
                    potential: sides[1],
                }
            }
            Kind::Product(k, factors) => {
                let mut factors = factors;
                // One factor holds all the dependence; the others are distributed over its parts.
                let at = factors
                    .iter()
                    .position(|(n, power)| *power == 1 && couples(dag, *n))?;
                if factors
                    .iter()
                    .enumerate()
                    .any(|(other, (n, _))| other != at && dag.dependence(*n).on(BOTH))
                {
                    return None;
                }
                let inner = *splits.get(&factors[at].0)?;
                factors[at].0 = inner.kinetic;
                let kinetic = dag.product(&k, &factors);
                factors[at].0 = inner.potential;
                Split {
                    kinetic,
                    potential: dag.product(&k, &factors),
                }
            }
            Kind::Reduce(domain, body) => {
                let inner = *splits.get(&body)?;
                Split {
                    kinetic: dag.reduce(domain, inner.kinetic),
                    potential: dag.reduce(domain, inner.potential),
                }
            }
            Kind::Select(condition, yes, no) if !dag.dependence(condition).on(BOTH) => {
                let (yes, no) = (*splits.get(&yes)?, *splits.get(&no)?);
                Split {
                    kinetic: dag.select(condition, yes.kinetic, no.kinetic),
                    potential: dag.select(condition, yes.potential, no.potential),
                }
            }
            _ => return None,
        };
        splits.insert(node, split);
    }
    splits.get(&root).copied()
}

/// The nodes that are looked into, children first: coupled ones, and their children.
fn spine(dag: &Dag, root: Node) -> Vec<Node> {
    let mut seen: Map<Node, ()> = Map::default();
    let mut found = Vec::new();
    let mut stack = vec![root];
    while let Some(node) = stack.pop() {
        if seen.insert(node, ()).is_some() {
            continue;
        }
        found.push(node);
        if couples(dag, node) {
            match dag.kind(node) {
                Kind::Sum(_, terms) => stack.extend(terms.iter().map(|(_, n)| *n)),
                Kind::Product(_, factors) => stack.extend(factors.iter().map(|(n, _)| *n)),
                Kind::Reduce(_, body) => stack.push(*body),
                Kind::Select(_, yes, no) => stack.extend([*yes, *no]),
                _ => {}
            }
        }
    }
    found.sort_unstable();
    found
}

/// Whether H(q,p) − H(q′,p) − H(q,p′) + H(q′,p′) is certainly not 0 somewhere: then no T and V
/// exist, whatever relations hold between the functions in H.
fn is_certainly_coupled(model: &Model, h: Node) -> bool {
    let sizes = vec![3; model.sizes.len()];
    for seed in 0..6 {
        let at = |q: u64, p: u64| {
            sample(
                model,
                &[h],
                &sizes,
                Sample {
                    seed,
                    q,
                    p,
                    signed: seed % 2 == 1,
                    ..Sample::default()
                },
                &[],
            )
            .map(|(values, _)| values[0])
        };
        let (Some(a), Some(b), Some(c), Some(d)) = (at(0, 0), at(1, 0), at(0, 1), at(1, 1)) else {
            return false;
        };
        let value = a.value - b.value - c.value + d.value;
        let size = a.value.abs() + b.value.abs() + c.value.abs() + d.value.abs();
        let error = a.error + b.error + c.error + d.error + size * f64::EPSILON;
        if value.is_finite() && value.abs() > 16.0 * error {
            return true;
        }
    }
    false
}
