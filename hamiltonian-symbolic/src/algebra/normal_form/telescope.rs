//! Sums over parts of a range as differences of sums from 0 on: Σ over 1..n of f(i) is Σ over 0..n less f(0).
//!
//! Input: an expression. Output: one with the same values in which the range of each sum is `0..form`, with a form
//! without a number, and the first element of its body has the index i. Invariant: an identity of sums over all
//! sequences f, so that values at indices outside an array, which cancel, do not matter. Assumes that a range has its
//! first value below its end or at it, for all sizes.

use crate::dag::{Dag, Kind, Map, Node};
use crate::index::{Affine, Domain, Index};
use crate::ranges::Ranges;
use crate::rational::Rational;

/// The most terms that are split off.
const MOST: i64 = 4;

/// The expression with sums over whole ranges; `None` if it has them already.
pub(super) fn telescoped(dag: &mut Dag, root: Node) -> Option<Node> {
    let nodes = dag.reachable(&[root]);
    let new: Map<Node, Node> = dag.map(nodes, |dag, node, new| match *dag.kind(node) {
        Kind::Reduce(domain, body) => {
            let body = new[&body];
            let (c, mut terms) = match dag.kind(body).clone() {
                Kind::Sum(c, terms) => (c, terms),
                _ => (Rational::ZERO, vec![(Rational::ONE, body)]),
            };
            let c = dag.constant(c);
            terms.push((Rational::ONE, c));
            let wholes: Vec<Option<Node>> = terms
                .iter()
                .map(|(_, term)| whole(dag, domain, *term))
                .collect();
            if wholes.iter().all(Option::is_none) {
                return dag.reduce(domain, body);
            }
            for ((_, term), whole) in terms.iter_mut().zip(wholes) {
                *term = whole.unwrap_or_else(|| dag.reduce(domain, *term));
            }
            dag.linear(&Rational::ZERO, &terms)
        }
        _ => dag.rebuild(node, &|child| new[&child]),
    });
    (new[&root] != root).then(|| new[&root])
}

/// A sum as one over a whole range and single terms.
fn whole(dag: &mut Dag, domain: Domain, body: Node) -> Option<Node> {
    let range = dag.range(domain).clone();
    let length = range.end.checked_plus(-1, &range.start)?;
    let by = offset(dag, domain, body);
    let first = range.start.as_constant()?.checked_add(by)?;
    let end = range.end.plus(1, &Affine::constant(by));
    let last = end.constant;
    let form = end.checked_plus(-1, &Affine::constant(last))?;
    let is_long = first.abs().max(last.abs()) > MOST;
    let is_whole = first == 0 && last == 0 && by == 0;
    if is_whole || is_long || form.as_constant().is_some() {
        return None;
    }
    if !(dag.is_never_negative(&length) && dag.is_never_negative(&form)) {
        return None;
    }
    let at = |dag: &mut Dag, index: &Affine| {
        let index = index.plus(-1, &Affine::constant(by));
        dag.replace(body, domain, &index)
    };
    let all = dag.domain(range.parent, Affine::constant(0), form.clone());
    let inside = at(dag, &Affine::variable(all));
    let mut terms = vec![(Rational::ONE, dag.reduce(all, inside))];
    // F(form + last) − F(first), where F(m) is the sum over 0..m.
    for (start, from, sign) in [
        (form, last, Rational::ONE),
        (Affine::constant(0), first, Rational::MINUS_ONE),
    ] {
        let sign = if from < 0 { sign.neg() } else { sign };
        for k in from.min(0)..from.max(0) {
            let term = at(dag, &start.plus(1, &Affine::constant(k)));
            terms.push((sign.clone(), term));
        }
    }
    Some(dag.linear(&Rational::ZERO, &terms))
}

/// The least c of the elements i + c in a body.
fn offset(dag: &Dag, domain: Domain, body: Node) -> i64 {
    let nodes = dag.reachable(&[body]);
    let indices = nodes.iter().filter_map(|node| match dag.kind(*node) {
        Kind::Element(_, row, column) => Some(std::iter::once(row).chain(column.as_deref())),
        _ => None,
    });
    let shift = |index: Index| {
        let is_plain = index.modulo.is_none();
        index
            .affine
            .shift(domain)?
            .as_constant()
            .filter(|_| is_plain)
    };
    let shifts = indices.flatten().flat_map(Index::axes).filter_map(shift);
    shifts.min().unwrap_or(0)
}
