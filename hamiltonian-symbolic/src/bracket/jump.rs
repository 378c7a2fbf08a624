//! Where an expression may jump.
//!
//! Input: expressions. Output: a part of them that is not known to be continuous. Invariant:
//! derivatives do not see a jump, so nothing is conserved across one because its derivatives say so.

use crate::dag::{Dag, Dependence, Kind, Node};
use crate::normal_form::{self, Scope};
use crate::op::Op;

/// The first condition on moving quantities whose branches are not known to meet where it
/// switches, sign of such, or angle of a point that moves.
pub(super) fn find(dag: &mut Dag, roots: &[Node]) -> Option<Node> {
    let nodes = dag.reachable(roots);
    nodes
        .into_iter()
        .find(|node| match dag.kind(*node).clone() {
            Kind::Select(condition, yes, no) => {
                dag.dependence(condition).on(Dependence::MOVING) && !meets(dag, condition, yes, no)
            }
            Kind::Call(Op::Sign | Op::Atan2, _) => dag.dependence(*node).on(Dependence::MOVING),
            _ => false,
        })
}

/// Whether two branches are known to agree where a comparison of a coordinate, a momentum or the
/// time with something else switches.
fn meets(dag: &mut Dag, condition: Node, yes: Node, no: Node) -> bool {
    let Kind::Compare(_, a, b) = *dag.kind(condition) else {
        return false;
    };
    [(a, b), (b, a)].into_iter().any(|(leaf, value)| {
        let is_leaf = matches!(dag.kind(leaf), Kind::Element(..) | Kind::Time);
        if !is_leaf || dag.reachable(&[value]).contains(&leaf) {
            return false;
        }
        let difference = dag.sub(yes, no);
        // What a sum binds is not the leaf, though it may be called like it.
        let difference = dag.nested(difference, dag.home(leaf));
        let difference = dag.substitute(difference, |_, node| (node == leaf).then_some(value));
        dag.is_zero(difference) || normal_form::vanishes(dag, difference, Scope::Everywhere)
    })
}
