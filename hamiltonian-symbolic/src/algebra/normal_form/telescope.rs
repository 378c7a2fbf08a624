//! Sums over parts of a range as differences of sums from 0 on: Σ over 1..n of f(i) is Σ over 0..n less f(0).
//!
//! Input: an expression. Output: one with the same values, in which each sum has the range `0..form`, with a form without
//! a constant, and the first element of its body has the index i. Loops of a few iterations are written out. Invariant: an
//! identity of sums over all sequences f. Values at indices outside an array cancel, so they do not matter. Assumes that
//! no range ends before its first value, for all sizes.

use crate::dag::{Dag, Kind, Map, Node};
use crate::index::{Affine, Domain, Index};
use crate::list::IntoList;
use crate::ranges::Ranges;
use crate::rational::Rational;

/// The most terms that are split off.
const MAX_SPLIT_OFF: i64 = 4;

/// The expression with sums over whole ranges; `None` if it has them already.
pub(super) fn telescoped(dag: &mut Dag, root: Node) -> Option<Node> {
    /// Terms that are split off a loop may have loops inside, over parts of their ranges.
    const DEPTH: usize = 3;
    let image = (0..DEPTH).fold(root, |image, _| once(dag, image));
    (image != root).then_some(image)
}

fn once(dag: &mut Dag, root: Node) -> Node {
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
                .into_list();
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
    new[&root]
}

/// A sum as one over a whole range and single terms.
fn whole(dag: &mut Dag, domain: Domain, body: Node) -> Option<Node> {
    let range = dag.range(domain).clone();
    let length = range.end.checked_plus(-1, &range.start)?;
    if let (Some(count @ ..=MAX_SPLIT_OFF), Some(first)) =
        (length.as_constant(), range.start.as_constant())
    {
        let mut terms = Vec::new();
        for index in first..first + count.max(0) {
            let term = dag.replace(body, domain, &Affine::constant(index));
            terms.push((Rational::ONE, term));
        }
        return Some(dag.linear(&Rational::ZERO, &terms));
    }
    let by = offset(dag, domain, body);
    // Both ends, as forms without a number and the numbers.
    let [start, end] = [&range.start, &range.end].map(|bound| {
        let number = bound.constant;
        let form = bound.checked_plus(-1, &Affine::constant(number));
        form.zip(number.checked_add(by))
    });
    let (start, end) = (start?, end?);
    let is_whole = start.0.as_constant().is_some() && start.1 == 0 && end.1 == 0 && by == 0;
    let is_long = start.1.abs().max(end.1.abs()) > MAX_SPLIT_OFF;
    let is_nested = !start.0.loops.is_empty();
    if is_whole || is_long || is_nested || end.0.as_constant().is_some() {
        return None;
    }
    let forms = [&length, &start.0, &end.0];
    if !forms.iter().all(|form| dag.is_never_negative(form)) {
        return None;
    }
    let at = |dag: &mut Dag, index: &Affine| {
        let index = index.plus(-1, &Affine::constant(by));
        dag.replace(body, domain, &index)
    };
    // F(end) − F(start), where F(m) is the sum over 0..m.
    let mut terms = Vec::new();
    for ((form, number), sign) in [(end, Rational::ONE), (start, Rational::MINUS_ONE)] {
        if form.as_constant().is_none() {
            let all = dag.domain(range.parent, Affine::constant(0), form.clone());
            let inside = at(dag, &Affine::variable(all));
            terms.push((sign.clone(), dag.reduce(all, inside)));
        }
        let sign = if number < 0 { sign.neg() } else { sign };
        for k in number.min(0)..number.max(0) {
            let term = at(dag, &form.plus(1, &Affine::constant(k)));
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
