//! Differences of two coordinates, such as q[i] − q[j] in 1/|q[i] − q[j]|, whose zero is a pole.

use crate::dag::{Array, Dag, Kind, Node};
use crate::op::Op;
use crate::ranges::Ranges;

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
    let row = |leaf: Node| match dag.kind(leaf) {
        Kind::Element(array, row, None) if row.as_loop().is_some() => Some((*array, row)),
        _ => None,
    };
    let (Some((one, i)), Some((other, j))) = (row(a), row(b)) else {
        return false;
    };
    one == other && dag.differ(i, j).is_some_and(|forms| forms.is_empty())
}
