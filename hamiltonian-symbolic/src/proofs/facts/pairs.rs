//! Differences of two leaves, at whose one meeting place a summand is infinite.

use crate::dag::{Array, Dag, Kind, Node};
use crate::index::{Affine, Domain};
use crate::op::Op;

/// The leaves of which a node is the difference, up to a number, an absolute value and a root.
pub fn difference(dag: &Dag, mut node: Node) -> Option<(Node, Node)> {
    while let Kind::Call(Op::Sqrt | Op::Abs | Op::Cbrt, x) = dag.kind(node) {
        node = x[0];
    }
    let Kind::Sum(c, terms) = dag.kind(node) else {
        return None;
    };
    let is_leaf = |n: Node| matches!(dag.kind(n), Kind::Element(Array::Phase(_), ..));
    match terms.as_slice() {
        [(k, a), (l, b)] if c.is_zero() && *k == l.neg() && is_leaf(*a) && is_leaf(*b) => {
            Some((*a.min(b), *a.max(b)))
        }
        _ => None,
    }
}

/// Returns true if two leaves are elements of one array at the variables of two loops, one of which stays
/// below the other: no two iterations have the same pair.
pub fn is_pair(dag: &Dag, (a, b): (Node, Node)) -> bool {
    let variable = |leaf: Node| match dag.kind(leaf) {
        Kind::Element(array, row, None) => Some((*array, row.as_loop()?)),
        _ => None,
    };
    let (Some((one, i)), Some((other, j))) = (variable(a), variable(b)) else {
        return false;
    };
    let is_below = |inner: Domain, outer: Domain| dag.range(inner).end == Affine::variable(outer);
    one == other && (is_below(i, j) || is_below(j, i))
}
