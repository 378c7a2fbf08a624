//! H as the terms it is written with, and as finer ones where a term has no flow.
//!
//! Input: H. Output: [`Units`]. Invariant: units add up to H with the constant; a term in which no
//! conjugate pair meets stays as it was written, or is part of a sum of such terms; products are multiplied
//! out only where no form takes them, and only where that loses few digits.

use super::flow;
use crate::dag::{Dag, Dependence, Kind, Node};
use crate::flows::limits::{REFINED, TERMS};
use crate::flows::space::Space;
use crate::index::Domain;
use crate::list::IntoList;
use crate::rational::Rational;
use crate::sort::Arrange;
use crate::structure::expand;

/// The most digits that multiplying out may lose, as a factor.
const LOSS: f64 = 16.0;

/// A term of H.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Unit {
    /// The term.
    pub(crate) node: Node,
    /// The term as it was written, which it is, or is a part of, or which is its first.
    pub(crate) source: Node,
    /// True if a conjugate pair meets in it.
    pub(crate) is_coupled: bool,
}

/// H by terms.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Units {
    pub(crate) units: Vec<Unit>,
    /// Terms that depend on no variable.
    pub(crate) constant: Vec<Node>,
}

/// The terms as they are written, those without a flow taken apart as little as helps; and, where
/// that is something else, all of them multiplied out.
pub(crate) fn refinements(space: &mut Space, h: Node) -> Vec<Units> {
    let written = written(space, h);
    let coupled = written.units.iter().filter(|unit| unit.is_coupled);
    if coupled.count() > TERMS {
        return vec![written];
    }
    let mut first = Units {
        units: Vec::new(),
        constant: written.constant.clone(),
    };
    let mut second = first.clone();
    let c = space.dag().coefficient();
    for unit in &written.units {
        if !unit.is_coupled {
            first.units.push(*unit);
            second.units.push(*unit);
            continue;
        }
        let whole = out(space, unit.node);
        if flow(space, unit.node, c).is_some() {
            first.units.push(*unit);
        } else {
            let apart = taken_apart(space, unit.node).unwrap_or_else(|| vec![unit.node]);
            append(space, &mut first, &apart, unit.source);
        }
        append(
            space,
            &mut second,
            &whole.unwrap_or_else(|| vec![unit.node]),
            unit.source,
        );
    }
    let (first, second) = (merged(space, first), merged(space, second));
    let is_other = second != first && second.units.len() <= REFINED;
    let mut all = vec![fewer(space, first)];
    all.extend(is_other.then_some(second));
    all
}

fn append(space: &mut Space, units: &mut Units, nodes: &[Node], source: Node) {
    for &node in nodes {
        match space.set(node).is_empty() {
            true => units.constant.push(node),
            false => {
                let is_coupled = !space.active(node).is_empty();
                units.units.push(Unit {
                    node,
                    source,
                    is_coupled,
                });
            }
        }
    }
}

/// Like terms of different origin are one.
fn merged(space: &mut Space, units: Units) -> Units {
    let mut out: Vec<(Rational, Node, Unit)> = Vec::new();
    for unit in units.units {
        let (k, bare) = space.dag().split_coefficient(unit.node);
        match out.iter_mut().find(|(_, node, _)| *node == bare) {
            Some(known) => known.0 = known.0.add(&k),
            None => out.push((k, bare, unit)),
        }
    }
    let mut merged = Units {
        units: Vec::new(),
        constant: units.constant,
    };
    for (k, bare, unit) in out {
        if !k.is_zero() {
            let node = space.dag().scale(&k, bare);
            merged.units.push(Unit { node, ..unit });
        }
    }
    merged
}

/// More units than are combined: those of coordinates alone become one, and so do those of momenta alone.
fn fewer(space: &mut Space, units: Units) -> Units {
    if units.units.len() <= TERMS {
        return units;
    }
    let mut fewer = Units {
        units: Vec::new(),
        constant: units.constant,
    };
    let mut sides = [Vec::new(), Vec::new()];
    for unit in units.units {
        match space.set(unit.node).sides() {
            (true, true) => fewer.units.push(unit),
            (has_coordinates, _) => sides[usize::from(has_coordinates)].push(unit),
        }
    }
    for side in sides {
        let nodes: Vec<Node> = side.iter().map(|unit| unit.node).into_list();
        let node = space.dag().add(&nodes);
        fewer
            .units
            .extend(side.first().map(|unit| Unit { node, ..*unit }));
    }
    fewer
}

/// The terms of H by its own sums.
fn written(space: &mut Space, h: Node) -> Units {
    let mut units = Units {
        units: Vec::new(),
        constant: Vec::new(),
    };
    for term in terms(space.dag(), h) {
        append(space, &mut units, &[term.body], term.body);
    }
    units
}

/// A term of H: a summand and its loops.
#[derive(Clone, Debug)]
pub(crate) struct LoopedTerm {
    /// The loops around it, outermost first.
    pub(crate) chain: Vec<Domain>,
    pub(crate) body: Node,
    /// The term as it was written: outside of loops the body.
    pub(crate) source: Node,
}

/// H by terms: through sums, loops and factors that do not move.
pub(crate) fn terms(dag: &mut Dag, h: Node) -> Vec<LoopedTerm> {
    let mut found = Vec::new();
    let mut left = vec![LoopedTerm {
        chain: Vec::new(),
        body: h,
        source: h,
    }];
    while let Some(term) = left.pop() {
        let (factor, inner) = opened(dag, term.body);
        let with = |body: Node| LoopedTerm {
            source: if term.chain.is_empty() {
                body
            } else {
                term.source
            },
            chain: term.chain.clone(),
            body,
        };
        match *dag.kind(inner) {
            Kind::Sum(..) => {
                let parts = distributed(dag, inner, factor);
                left.extend(parts.into_iter().rev().map(with));
            }
            Kind::Reduce(domain, body) => {
                let mut chain = term.chain.clone();
                chain.push(domain);
                left.push(LoopedTerm {
                    chain,
                    body: dag.mul(&[factor, body]),
                    source: term.source,
                });
            }
            _ => found.push(counted(dag, term)),
        }
    }
    found
}

/// A term without the inner loops whose variables it does not read: it stands there as often as they run.
fn counted(dag: &mut Dag, mut term: LoopedTerm) -> LoopedTerm {
    while let Some(&innermost) = term.chain.last()
        && !dag.variables(term.body).has(innermost)
    {
        term.chain.pop();
        let count = dag.count(innermost);
        term.body = dag.mul(&[count, term.body]);
    }
    term
}

/// A sum or a loop with the factor beside it, in which nothing moves; other expressions as they are.
fn opened(dag: &mut Dag, node: Node) -> (Node, Node) {
    let moving = Dependence(Dependence::Q.0 | Dependence::P.0);
    if let Kind::Product(k, factors) = dag.kind(node).clone() {
        let mut those = factors
            .iter()
            .filter(|(n, _)| dag.dependence(*n).on(moving));
        if let (Some(&(inner, 1)), None) = (those.next(), those.next())
            && matches!(dag.kind(inner), Kind::Sum(..) | Kind::Reduce(..))
        {
            let rest = factors.iter().filter(|(n, _)| *n != inner).copied();
            let rest: Vec<(Node, i32)> = rest.into_list();
            return (dag.product(&k, &rest), inner);
        }
    }
    (dag.integer(1), node)
}

/// A sum times a factor, term by term; another expression is a sum of one term.
pub(crate) fn distributed(dag: &mut Dag, sum: Node, factor: Node) -> Vec<Node> {
    let Kind::Sum(c, terms) = dag.kind(sum).clone() else {
        return vec![dag.mul(&[factor, sum])];
    };
    let mut parts: Vec<Node> = Vec::new();
    for (k, node) in terms {
        let term = dag.mul(&[factor, node]);
        parts.push(dag.scale(&k, term));
    }
    if !c.is_zero() {
        parts.push(dag.scale(&c, factor));
    }
    parts
}

/// The term multiplied out by one of its factors: the one that leaves fewest parts without a flow.
fn taken_apart(space: &mut Space, node: Node) -> Option<Vec<Node>> {
    let Kind::Product(k, factors) = space.dag().kind(node).clone() else {
        return out(space, node);
    };
    let c = space.dag().coefficient();
    let mut best: Option<(usize, Vec<Node>)> = None;
    for (at, (factor, n)) in factors.iter().enumerate() {
        if *n != 1 || !matches!(space.dag().kind(*factor), Kind::Sum(..)) {
            continue;
        }
        let mut rest = factors.clone();
        rest.remove(at);
        let rest = space.dag().product(&k, &rest);
        let parts = distributed(space.dag(), *factor, rest);
        if loss(space, &parts, node) > LOSS {
            continue;
        }
        let mut bad = 0;
        for &part in &parts {
            bad += usize::from(flow(space, part, c).is_none());
        }
        if best.as_ref().is_none_or(|(least, _)| bad < *least) {
            best = Some((bad, parts));
        }
    }
    match best {
        Some((0, parts)) => Some(parts),
        _ => out(space, node).or(best.map(|(_, parts)| parts)),
    }
}

/// The term multiplied out altogether.
fn out(space: &mut Space, node: Node) -> Option<Vec<Node>> {
    let terms = expand(space.dag(), node)?;
    if terms.len() > 16 {
        return None;
    }
    let parts: Vec<Node> = terms.iter().map(|term| term.node(space.dag())).into_list();
    (loss(space, &parts, node) <= LOSS).then_some(parts)
}

/// Σ|parts|/|whole|, the median of some points near and far, with momenta of either sign: a whole that vanishes
/// somewhere loses digits there in any form.
fn loss(space: &mut Space, parts: &[Node], whole: Node) -> f64 {
    let set = space.set(whole);
    let momenta = set.members().filter(|one| !one.is_coordinate()).collect();
    let mut losses = Vec::new();
    let steps = [0.0, 1.0, 2.0, 4.0, 8.0].into_iter();
    for (step, back) in steps.flat_map(|step| [(step, 0.0), (step, -32.0)]) {
        let point = space.point_off(&[(set, step), (momenta, back)]);
        let mut sum = 0.0;
        for part in parts {
            sum += space.value_at(*part, &point).value.abs();
        }
        let whole = space.value_at(whole, &point);
        let loss = sum / whole.value.abs();
        // If rounding hides the whole, the ratio has no meaning.
        losses.extend((whole.is_nonzero() && loss.is_finite()).then_some(loss));
    }
    losses.arrange_by(f64::total_cmp);
    losses.get(losses.len() / 2).copied().unwrap_or(1.0)
}
