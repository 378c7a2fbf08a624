//! Products with a factor that vanishes on a set: where it vanishes, nothing else of the product counts.
//!
//! Input: roots. Output: the same functions, in which a product with factors such as `if c { a } else { 0 }` and
//! others that may be infinite, or have infinite derivatives, is `if c { product } else { 0 }`. Invariant: before
//! differentiation, so that the branch not taken reaches no derivative of any order; a product of factors that are
//! finite with all derivatives is left as it is, since 0 times these is 0.

use crate::dag::{Dag, Dependence, Kind, Map, Node};
use crate::index::Domain;
use crate::list::IntoList;
use crate::op::Op;
use crate::product::{Factors, Product};
use crate::rational::Rational;

/// The zeros and singularities of a node.
#[derive(Clone, Copy, Default)]
struct Vanishing {
    /// The condition outside which it is 0.
    support: Option<Node>,
    /// True if it, or a derivative of it, may be infinite or NaN where the state is finite.
    is_singular: bool,
}

/// Rewrites the expressions the roots stand for.
pub fn support(dag: &mut Dag, roots: &mut [Node]) {
    let order = dag.reachable(roots);
    let may_vanish = |node: &Node| {
        matches!(
            dag.kind(*node),
            Kind::Select(..) | Kind::Call(Op::Min | Op::Max | Op::Sign, _)
        )
    };
    if !order.iter().any(may_vanish) {
        return;
    }
    let mut known: Map<Node, Vanishing> = Map::default();
    let new = dag.map(order, |dag, node, new| {
        let node = dag.rebuild(node, &|child| new[&child]);
        let image = match dag.kind(node) {
            Kind::Product(..) if !dag.is_sealed(node) => within_support(dag, node, &mut known),
            _ => node,
        };
        facts(dag, image, &mut known);
        image
    });
    for root in roots {
        *root = new[root];
    }
}

/// The facts of a node and, first, of those below it.
fn facts(dag: &mut Dag, root: Node, known: &mut Map<Node, Vanishing>) -> Vanishing {
    if let Some(facts) = known.get(&root) {
        return *facts;
    }
    let order = dag.reached(&[root], &mut |node, worklist| {
        dag.for_children(node, |child| {
            if !known.contains_key(&child) {
                worklist.add(child);
            }
        });
    });
    for node in order {
        if !known.contains_key(&node) {
            let own = Vanishing {
                support: support_of(dag, node, known),
                is_singular: is_singular(dag, node, known),
            };
            known.insert(node, own);
        }
    }
    known[&root]
}

/// Returns true if a node or a derivative of it may be infinite or NaN at a finite state.
fn is_singular(dag: &Dag, node: Node, known: &Map<Node, Vanishing>) -> bool {
    if !dag.dependence(node).on(Dependence::MOVING) {
        return false;
    }
    let moves = |node: Node| dag.dependence(node).on(Dependence::MOVING);
    let own = match dag.kind(node) {
        Kind::Call(op, _) => !matches!(
            op,
            Op::Sin
                | Op::Cos
                | Op::Tanh
                | Op::Atan
                | Op::Asinh
                | Op::Erf
                | Op::Erfc
                | Op::Abs
                | Op::Floor
                | Op::Round
                | Op::Sign
                | Op::Min
                | Op::Max
        ),
        Kind::External(..) => true,
        Kind::Product(_, factors) => factors.iter().any(|(node, n)| *n < 0 && moves(*node)),
        _ => false,
    };
    let mut is_singular = own;
    dag.for_children(node, |child| is_singular |= known[&child].is_singular);
    is_singular
}

/// The condition outside which a node is 0.
fn support_of(dag: &mut Dag, node: Node, known: &Map<Node, Vanishing>) -> Option<Node> {
    let of = |node: &Node| known[node].support;
    match dag.kind(node).clone() {
        Kind::Select(condition, yes, _) if dag.is_zero(yes) => Some(dag.not(condition)),
        Kind::Select(condition, _, no) if dag.is_zero(no) => Some(condition),
        Kind::Select(condition, yes, no) => {
            let (yes, no) = (of(&yes)?, of(&no)?);
            let otherwise = dag.not(condition);
            let (yes, no) = (dag.and(condition, yes), dag.and(otherwise, no));
            Some(dag.or(yes, no))
        }
        // A NaN stays one, and where both are equal the derivative is the first's.
        Kind::Call(op @ (Op::Min | Op::Max), x) => {
            let (a, b) = (x[0], x[1]);
            let outside = match (op, dag.is_zero(a), dag.is_zero(b)) {
                (Op::Max, false, true) => dag.less(a, b),
                (Op::Max, true, false) => dag.less_equal(b, a),
                (Op::Min, false, true) => dag.less(b, a),
                (Op::Min, true, false) => dag.less_equal(a, b),
                _ => return None,
            };
            Some(dag.not(outside))
        }
        Kind::Call(op, x) if x.len() == 1 && op.at_zero().is_some_and(|y| y.is_zero()) => of(&x[0]),
        Kind::Sum(c, terms) if !c.is_zero() => {
            // 1 + sign(x), 1 - sign(x)
            let [(k, term)] = terms.as_slice() else {
                return None;
            };
            let Kind::Call(Op::Sign, x) = dag.kind(*term).clone() else {
                return None;
            };
            if k.abs() != c.abs() {
                return None;
            }
            let zero = dag.integer(0);
            let outside = match *k == c {
                true => dag.less(x[0], zero),
                false => dag.less(zero, x[0]),
            };
            Some(dag.not(outside))
        }
        Kind::Sum(_, terms) => {
            let supports: Option<Vec<Node>> = terms.iter().map(|(_, node)| of(node)).collect();
            supports?.into_iter().reduce(|all, next| dag.or(all, next))
        }
        Kind::Product(_, factors) => {
            let own = factors.iter().filter(|(_, n)| *n > 0);
            let supports: Vec<Node> = own.filter_map(|(node, _)| of(node)).into_list();
            supports.into_iter().reduce(|all, next| dag.and(all, next))
        }
        _ => None,
    }
}

/// The product, inside the support of its factors where another factor is singular.
fn within_support(dag: &mut Dag, node: Node, known: &mut Map<Node, Vanishing>) -> Node {
    let Product {
        coefficient,
        factors,
    } = Product::of(dag, node);
    let own: Vec<Vanishing> = factors
        .iter()
        .map(|(factor, _)| facts(dag, *factor, known))
        .into_list();
    let vanishes = |at: usize| factors[at].1 > 0 && own[at].support.is_some();
    let is_singular: Vec<bool> = (factors.iter().zip(&own))
        .map(|((factor, n), own)| {
            own.is_singular || *n < 0 && dag.dependence(*factor).on(Dependence::MOVING)
        })
        .into_list();
    let is_other_singular = |at: usize| (0..own.len()).any(|k| k != at && is_singular[k]);
    let places: Vec<usize> = (0..own.len()).filter(|at| vanishes(*at)).into_list();
    if places.iter().any(|at| is_other_singular(*at)) {
        let supports = places.iter().filter_map(|at| own[*at].support);
        let condition = supports.reduce(|all, next| dag.and(all, next));
        let taken: Factors = factors
            .iter()
            .map(|&(factor, n)| match (n > 0).then(|| branch(dag, factor)) {
                Some(inner) => (inner, n),
                None => (factor, n),
            })
            .into_list();
        let product = dag.product(&Rational::ONE, &taken);
        let zero = dag.integer(0);
        let Some(condition) = condition else {
            return node;
        };
        let image = dag.select(condition, product, zero);
        return dag.scale(&coefficient, image);
    }
    // Terms of a sum over a loop that vanish take singular factors into the sum.
    let mut sums: Vec<(usize, Domain, Node)> = Vec::new();
    for (at, &(factor, n)) in factors.iter().enumerate() {
        if let Kind::Reduce(domain, body) = *dag.kind(factor)
            && n > 0
            && is_other_singular(at)
            && facts(dag, body, known).support.is_some()
        {
            sums.push((at, domain, body));
        }
    }
    if let Some(&(at, domain, body)) = sums.first() {
        let singular = |k: usize| k != at && is_singular[k];
        let (mut inside, mut outside) = (vec![(body, 1)], Factors::new());
        for (k, power) in factors.iter().enumerate().filter(|(k, _)| *k != at) {
            match singular(k) {
                true => inside.push(*power),
                false => outside.push(*power),
            }
        }
        let nodes: Vec<Node> = inside.iter().skip(1).map(|(node, _)| *node).into_list();
        if sums.len() > 1 || factors[at].1 > 1 || dag.has_loops(&nodes) {
            return where_terms_count(dag, &sums, node, known);
        }
        let product = dag.product(&Rational::ONE, &inside);
        let product = within_support(dag, product, known);
        outside.push((dag.reduce(domain, product), 1));
        return dag.product(&coefficient, &outside);
    }
    node
}

/// The product with sums over loops, where of each sum a term does not vanish: for several sums, factors with loops of
/// their own, and powers.
fn where_terms_count(
    dag: &mut Dag,
    sums: &[(usize, Domain, Node)],
    product: Node,
    known: &mut Map<Node, Vanishing>,
) -> Node {
    let (zero, one) = (dag.integer(0), dag.integer(1));
    let mut conditions = Vec::new();
    for &(_, domain, body) in sums {
        if let Some(support) = facts(dag, body, known).support {
            let counted = dag.select(support, one, zero);
            let count = dag.reduce(domain, counted);
            conditions.push(dag.less(zero, count));
        }
    }
    let condition = conditions
        .into_iter()
        .reduce(|all, next| dag.and(all, next));
    condition.map_or(product, |condition| dag.select(condition, product, zero))
}

/// The branch of a choice between an expression and 0: where the product counts it is taken.
fn branch(dag: &Dag, node: Node) -> Node {
    match *dag.kind(node) {
        Kind::Select(_, yes, no) if dag.is_zero(no) => yes,
        Kind::Select(_, yes, no) if dag.is_zero(yes) => no,
        _ => node,
    }
}
