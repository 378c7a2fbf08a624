//! Elements of an array and sums over all of them.
//!
//! Input: momenta of element k in 0..rows. Output: the same in a form that shows whose velocities
//! they depend on. Invariant: what is rewritten has the same value for every k in 0..rows and all
//! sizes.

use crate::dag::{Dag, Dependence, Kind, Node};

/// Whether a sum over velocities stands in the expression.
pub(super) fn has_sums_of_velocities(dag: &Dag, root: Node) -> bool {
    let nodes = dag.reachable(&[root]);
    nodes.iter().any(|node| is_sum_of_velocities(dag, *node))
}

fn is_sum_of_velocities(dag: &Dag, node: Node) -> bool {
    matches!(dag.kind(node), Kind::Reduce(..)) && dag.dependence(node).on(Dependence::P)
}

/// The expression with all velocities in its sums at rest, which it does not depend on.
pub(super) fn with_sums_at_rest(dag: &mut Dag, root: Node) -> Node {
    dag.substitute(root, |dag, node| {
        is_sum_of_velocities(dag, node).then(|| super::at_rest(dag, node))
    })
}
