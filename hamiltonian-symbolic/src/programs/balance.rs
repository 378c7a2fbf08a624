//! Long products as balanced trees of products of two.
//!
//! Input: roots. Output: the same functions in which a product of more than `SHORT` factors that
//! are not prepared is a tree. Invariant: a gradient through a tree costs two multiplications a
//! factor (Speelpenning 1980), and so does every later pass; the factors keep their order.

use crate::algebra::simplify::SHORT;
use crate::dag::{Dag, Kind, Node};
use crate::list::IntoList;
use crate::product::Factors;
use crate::programs::factor::is_prepared;
use crate::rational::Rational;
use crate::sort::Arrange;

/// Rewrites the expressions the roots stand for.
pub fn balance(dag: &mut Dag, roots: &mut [Node]) {
    let order = dag.reachable(roots);
    let is_long =
        |node: &Node| matches!(dag.kind(*node), Kind::Product(_, factors) if factors.len() > SHORT);
    if !order.iter().any(is_long) {
        return;
    }
    let new = dag.map(order, |dag, node, new| match dag.kind(node).clone() {
        Kind::Product(k, factors) if factors.len() > SHORT => {
            let factors = factors.iter().map(|(f, n)| (new[f], *n)).into_list();
            balanced(dag, &k, factors)
        }
        _ => dag.rebuild(node, &|child| new[&child]),
    });
    for root in roots {
        *root = new[root];
    }
}

/// `k·Π node^n`: prepared factors as they are, those above and those below the line as a tree each.
fn balanced(dag: &mut Dag, k: &Rational, factors: Factors) -> Node {
    let (mut all, rest): (Vec<_>, Vec<_>) = factors
        .into_iter()
        .partition(|(node, _)| is_prepared(dag, *node));
    if rest.len() <= SHORT {
        all.extend(rest);
        return dag.product(k, &all);
    }
    let (above, below): (Vec<_>, Vec<_>) = rest.into_iter().partition(|(_, n)| *n > 0);
    for (side, sign) in [(above, 1), (below, -1)] {
        if side.len() <= SHORT / 2 {
            all.extend(side);
        } else {
            let leaves = side
                .iter()
                .map(|(node, n)| dag.powi(*node, n * sign))
                .into_list();
            all.push((tree(dag, leaves), sign));
        }
    }
    dag.product(k, &all)
}

/// The product of nodes as a tree; those of outer loops first, each loop's by themselves.
fn tree(dag: &mut Dag, mut leaves: Vec<Node>) -> Node {
    let depth = |dag: &Dag, node: Node| dag.depth(dag.home(node));
    leaves.arrange_by_key(|node| depth(dag, *node));
    let mut runs: Vec<Vec<Node>> = Vec::new();
    for node in leaves {
        match runs.last_mut() {
            Some(run) if depth(dag, run[0]) == depth(dag, node) => run.push(node),
            _ => runs.push(vec![node]),
        }
    }
    let trees: Vec<Node> = runs.into_iter().map(|run| halved(dag, run)).into_list();
    let mut trees = trees.into_iter();
    let first = trees.next().unwrap_or_else(|| dag.integer(1));
    trees.fold(first, |product, tree| dag.seal(product, tree))
}

/// Neighbours multiplied until one node is left.
fn halved(dag: &mut Dag, mut level: Vec<Node>) -> Node {
    while level.len() > 1 {
        let pairs = level.chunks(2);
        level = pairs
            .map(|pair| match pair {
                [a, b] => dag.seal(*a, *b),
                _ => pair[0],
            })
            .into_list();
    }
    level[0]
}
