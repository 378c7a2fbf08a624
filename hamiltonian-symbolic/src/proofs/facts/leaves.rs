//! Dependence of expressions on coordinates, momenta and time: which of them they vary with, and where
//! they vanish together.

use crate::dag::{Array, Dag, Dependence, Kind, Node, Side};
use crate::index::Domain;
use crate::list::IntoList;
use crate::op::Break;

/// A coordinate, a momentum, the time.
pub fn is_moving_leaf(dag: &Dag, node: Node) -> bool {
    let is_leaf = matches!(dag.kind(node), Kind::Element(..) | Kind::Time);
    is_leaf && dag.dependence(node).on(Dependence::MOVING)
}

/// Returns true if a node varies with what moves, whatever the parameters: its zeros are not everything,
/// but in iterations of loops in which two leaves are the same one and it is 0.
pub fn varies(dag: &Dag, node: Node) -> bool {
    let is_leaf = |n: Node| matches!(dag.kind(n), Kind::Element(Array::Phase(_), ..) | Kind::Time);
    match dag.kind(node) {
        Kind::Product(_, factors) => factors.iter().all(|(factor, n)| {
            varies(dag, *factor) || *n < 0 && !dag.dependence(*factor).on(Dependence::MOVING)
        }),
        // A function that jumps may be constant between its jumps.
        Kind::Call(op, x) => {
            let row = op.row();
            let jumps = matches!(row.regularity.breaks, Break::Jump(_));
            row.arguments.len() == 1 && !jumps && varies(dag, x[0])
        }
        // A leaf that one term reads alone.
        Kind::Sum(_, terms) => terms.iter().enumerate().any(|(at, (_, term))| {
            let leaves = || dag.reachable(&[*term]).into_iter().filter(|n| is_leaf(*n));
            let mut others = terms.iter().enumerate().filter(|(other, _)| *other != at);
            varies(dag, *term)
                && others.all(|(_, (_, other))| {
                    let nodes = dag.reachable(&[*other]);
                    leaves().all(|leaf| nodes.binary_search(&leaf).is_err())
                })
        }),
        _ => is_leaf(node),
    }
}

/// Returns true if one expression is 0 at one value of a coordinate or momentum that the other does not read,
/// as x + cos t is beside y + sin t: where the other is 0, too, two dimensions are lost.
pub fn is_solved_beside(dag: &Dag, one: Node, other: Node) -> bool {
    let others = moving(dag, other);
    let is_free = |leaf: Node| {
        let own = moving(dag, leaf);
        !own.iter()
            .any(|own| others.iter().any(|other| may_be_same(*own, *other)))
    };
    let mut node = one;
    while let Kind::Product(_, factors) = dag.kind(node)
        && let [(factor, 1..)] = factors.as_slice()
    {
        node = *factor;
    }
    let Kind::Sum(_, terms) = dag.kind(node) else {
        return false;
    };
    terms.iter().enumerate().any(|(at, (_, leaf))| {
        let reads = |node: Node| dag.reachable(&[node]).binary_search(leaf).is_ok();
        let mut rest = terms.iter().enumerate().filter(|(other, _)| *other != at);
        // At the variables of loops, another leaf may be the same element.
        let is_plain = matches!(dag.kind(*leaf), Kind::Element(Array::Phase(_), ..))
            && dag.variables(*leaf).is_empty();
        is_plain && is_free(*leaf) && rest.all(|(_, (_, term))| !reads(*term))
    })
}

/// A coordinate or momentum: its array, and its row where that is a number. Nothing is the time.
type Leaf = Option<(Array, Option<i64>)>;

fn may_be_same(a: Leaf, b: Leaf) -> bool {
    match (a, b) {
        (None, None) => true,
        (Some((a, i)), Some((b, j))) => a == b && (i.is_none() || j.is_none() || i == j),
        _ => false,
    }
}

/// Returns true if no coordinate or momentum, and not the time, is read by both: their zeros and poles meet
/// in sets that separate nothing.
pub fn have_nothing_in_common(dag: &Dag, a: Node, b: Node) -> bool {
    let others = moving(dag, b);
    !moving(dag, a)
        .iter()
        .any(|a| others.iter().any(|b| may_be_same(*a, *b)))
}

/// Returns true if no pair of a coordinate and its momentum is read by both, nor the time, and the first
/// reads coordinates or momenta only: where it is infinite, so are the momenta or coordinates of its pairs,
/// whatever the other is.
pub fn have_no_degree_in_common(dag: &Dag, a: Node, b: Node) -> bool {
    let degree = |leaf: Leaf| match leaf {
        Some((Array::Phase(column), row)) => Some((Array::Phase(column.on(Side::Q)), row)),
        other => other,
    };
    let is_of = |leaf: &Leaf, wanted: Side| matches!(leaf, Some((Array::Phase(column), _)) if column.side == wanted);
    let [own, others] = [moving(dag, a), moving(dag, b)];
    let is_of_one_side = [Side::Q, Side::P]
        .into_iter()
        .any(|side| own.iter().all(|leaf| is_of(leaf, side)));
    is_of_one_side
        && !own.iter().any(|a| {
            let mut others = others.iter();
            others.any(|b| may_be_same(degree(*a), degree(*b)))
        })
}

/// Returns true if each iteration of a loop reads elements of its own row alone, and not the time.
pub fn is_of_own_rows(dag: &Dag, body: Node, domain: Domain) -> bool {
    dag.reachable(&[body])
        .into_iter()
        .all(|node| match dag.kind(node) {
            Kind::Element(Array::Phase(_), row, _) => row.as_loop() == Some(domain),
            Kind::Time => false,
            _ => true,
        })
}

/// The coordinates, momenta and time in a node.
fn moving(dag: &Dag, node: Node) -> Vec<Leaf> {
    let leaf = |node: Node| match dag.kind(node) {
        Kind::Time => Some(None),
        Kind::Element(array @ Array::Phase(_), row, _) => Some(Some((*array, row.as_constant()))),
        _ => None,
    };
    dag.reachable(&[node])
        .into_iter()
        .filter_map(leaf)
        .into_list()
}
