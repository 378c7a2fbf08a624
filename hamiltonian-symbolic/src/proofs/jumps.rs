//! Jumps of H in time, at times that do not depend on the state.
//!
//! Input: a part of H, or a force. Output: true if it may jump. Invariant: where conditions and functions are of the
//! time and parameters alone, an expression that is said not to jump is continuous in time. Functions written in Rust
//! are taken for continuous.

use crate::bracket::agree;
use crate::dag::{Dag, Dependence, Kind, Node};
use crate::facts::{Facts, Given, comparisons};
use crate::list::IntoList;
use crate::op::Break;

/// Returns true if a part of H may jump at times that do not depend on the state. Terms that do not depend on the state
/// move nothing.
#[must_use]
pub fn jumps(dag: &mut Dag, h: Node) -> bool {
    let terms = match dag.kind(h) {
        Kind::Sum(_, terms) => terms.iter().map(|(_, term)| *term).into_list(),
        _ => vec![h],
    };
    let moving: Vec<Node> = terms
        .into_iter()
        .filter(|term| reads_state(dag, *term))
        .into_list();
    force_jumps(dag, &moving)
}

/// Returns true if a force may jump at times that do not depend on the state.
#[must_use]
pub fn force_jumps(dag: &mut Dag, values: &[Node]) -> bool {
    dag.reachable(values)
        .into_iter()
        .any(|node| switches(dag, node))
}

fn reads_state(dag: &Dag, node: Node) -> bool {
    let state = Dependence(Dependence::Q.0 | Dependence::P.0);
    dag.dependence(node).on(state)
}

/// Returns true if a node itself may jump where an expression of the time alone passes a value.
fn switches(dag: &mut Dag, node: Node) -> bool {
    let is_timed = |dag: &Dag, nodes: &[Node]| {
        nodes
            .iter()
            .any(|node| dag.dependence(*node).on(Dependence::TIME))
            && !nodes.iter().any(|node| reads_state(dag, *node))
    };
    match *dag.kind(node) {
        Kind::Select(condition, yes, no) => {
            let timed = comparisons(dag, condition).into_iter();
            let timed = timed.filter(|(a, b)| is_timed(dag, &[*a, *b])).into_list();
            timed.into_iter().any(|sides| !agree(dag, sides, yes, no))
        }
        Kind::Call(op, ref x) if matches!(op.row().regularity.breaks, Break::Jump(_)) => {
            is_timed(dag, x)
                && !Facts::everywhere(dag, &[node], &Given::default())
                    .get(node)
                    .is_projective
        }
        _ => false,
    }
}
