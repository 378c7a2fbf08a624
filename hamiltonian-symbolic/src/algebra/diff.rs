//! Derivatives: the whole gradient in one reverse sweep, directional derivatives in one forward
//! sweep.
//!
//! Input: a scalar expression. Output: adjoints of its leaves, each living in the leaf's own loop:
//! where a leaf depends on loop variables, its adjoint is what every iteration adds to that
//! element. Invariant: the branch of an `if` that is not taken never reaches a derivative: each
//! branch is differentiated by itself and the derivatives are selected.

use crate::dag::{Array, Dag, Dependence, Kind, Map, Node};
use crate::index::Domain;
use crate::list::IntoList;
use crate::op::Op;
use crate::rational::Rational;
use crate::sort::Arrange;

/// The adjoints of the leaves that depend on `what`: (leaf, ∂root/∂leaf) in order of first
/// appearance. Zero adjoints are left out.
pub fn gradient(dag: &mut Dag, root: Node, what: Dependence) -> Vec<(Node, Node)> {
    sweep(dag, root, what, None, &mut Map::default())
}

/// Adjoints by leaf.
type Adjoints = Vec<(Node, Node)>;
/// Adjoints of branches by branch and loop: many conditions may share a branch.
type Swept = Map<(Node, Option<Domain>), Adjoints>;

/// Adjoints in the context of a loop: contributions are summed over the loops inside `context`
/// only.
fn sweep(
    dag: &mut Dag,
    root: Node,
    what: Dependence,
    context: Option<Domain>,
    swept: &mut Swept,
) -> Adjoints {
    if !dag.dependence(root).on(what) {
        return Vec::new();
    }
    let order = dag.reachable(&[root]);
    let mut contributions: Map<Node, Vec<Node>> = Map::default();
    contributions.insert(root, vec![dag.integer(1)]);
    let mut leaves = Vec::new();
    for &node in order.iter().rev() {
        let Some(mut parts) = contributions.take(&node) else {
            continue;
        };
        // Users were visited last to first; the source's order is the other way.
        parts.reverse();
        let adjoint = dag.add_with_content(&parts);
        if dag.is_zero(adjoint) {
            continue;
        }
        let here = inner(dag, dag.home(node), context);
        let mut give = |dag: &mut Dag, child: Node, within: Option<Domain>, value: Node| {
            if dag.dependence(child).on(what) && !dag.is_zero(value) {
                let value = sum_out(dag, child, within, context, value);
                contributions.entry(child).or_default().push(value);
            }
        };
        match dag.kind(node).clone() {
            Kind::Sum(_, terms) => {
                for (k, child) in terms.into_iter().rev() {
                    let value = dag.scale(&k, adjoint);
                    give(dag, child, here, value);
                }
            }
            Kind::Product(_, factors) if dag.is_sealed(node) => {
                let (a, b) = (factors[0].0, factors[1].0);
                for (child, other) in [(b, a), (a, b)] {
                    if dag.dependence(child).on(what) {
                        let value = dag.seal(adjoint, other);
                        give(dag, child, here, value);
                    }
                }
            }
            Kind::Call(Op::Min | Op::Max, _) | Kind::Select(..) => {
                let branches = Branches::of(dag, node);
                for (leaf, value) in branches.adjoints(dag, adjoint, what, here, swept) {
                    give(dag, leaf, here, value);
                }
            }
            Kind::Product(..) | Kind::Call(..) | Kind::External(..) => {
                for (child, partial) in partials(dag, node, what).into_iter().rev() {
                    let value = dag.mul(&[adjoint, partial]);
                    give(dag, child, here, value);
                }
            }
            Kind::Reduce(domain, body) => give(dag, body, Some(domain), adjoint),
            Kind::Scalar(_)
            | Kind::Time
            | Kind::Coefficient
            | Kind::Element(..)
            | Kind::StandIn(_) => leaves.push((node, adjoint)),
            Kind::Constant(_)
            | Kind::Pi
            | Kind::Variable(_)
            | Kind::Extent(_)
            | Kind::Count(_)
            | Kind::Compare(..)
            | Kind::Not(_)
            | Kind::And(..)
            | Kind::Or(..) => {}
        }
    }
    // Leaves that only the sums of branches have.
    let mut inside: Vec<(Node, Vec<Node>)> = contributions.into_iter().into_list();
    inside.arrange_by_key(|(leaf, _)| *leaf);
    for (leaf, mut parts) in inside {
        parts.reverse();
        let adjoint = dag.add_with_content(&parts);
        if !dag.is_zero(adjoint) {
            leaves.push((leaf, adjoint));
        }
    }
    leaves.arrange_by_key(|(leaf, _)| *leaf);
    leaves
}

/// Two expressions of which a condition takes one.
struct Branches {
    condition: Node,
    yes: Node,
    no: Node,
}

impl Branches {
    /// The branches of a condition, of a minimum or of a maximum.
    fn of(dag: &mut Dag, node: Node) -> Branches {
        let (condition, yes, no) = match *dag.kind(node) {
            Kind::Select(condition, yes, no) => (condition, yes, no),
            Kind::Call(op, ref x) => {
                let (a, b) = (x[0], x[1]);
                let condition = match op {
                    Op::Min => dag.less_equal(a, b),
                    _ => dag.less_equal(b, a),
                };
                (condition, a, b)
            }
            ref other => unreachable!("{other:?} has no branches"),
        };
        Branches { condition, yes, no }
    }

    /// The derivatives of both by the leaves, times the adjoint, selected.
    fn adjoints(
        &self,
        dag: &mut Dag,
        adjoint: Node,
        what: Dependence,
        here: Option<Domain>,
        swept: &mut Swept,
    ) -> Adjoints {
        let zero = dag.integer(0);
        let [from_yes, from_no] = [self.yes, self.no].map(|branch| {
            if let Some(known) = swept.get(&(branch, here)) {
                return known.clone();
            }
            let own = dag.nested(branch, here);
            let adjoints = sweep(dag, own, what, here, swept);
            swept.insert((branch, here), adjoints.clone());
            adjoints
        });
        let mut leaves: Vec<Node> = from_yes.iter().chain(&from_no).map(|(l, _)| *l).into_list();
        leaves.arrange();
        leaves.dedup();
        let by = |list: &Adjoints, leaf: Node| {
            list.binary_search_by_key(&leaf, |(l, _)| *l)
                .map_or(zero, |at| list[at].1)
        };
        leaves
            .into_iter()
            .map(|leaf| {
                let (a, b) = (by(&from_yes, leaf), by(&from_no, leaf));
                let value = if dag.as_constant(a).is_some() || dag.as_constant(b).is_some() {
                    // An infinite adjoint adds nothing through the branch not taken.
                    let (a, b) = (dag.mul(&[adjoint, a]), dag.mul(&[adjoint, b]));
                    dag.select(self.condition, a, b)
                } else {
                    let slope = dag.select(self.condition, a, b);
                    dag.mul(&[adjoint, slope])
                };
                (leaf, value)
            })
            .into_list()
    }
}

/// The deeper of two loops on one path.
fn inner(dag: &Dag, a: Option<Domain>, b: Option<Domain>) -> Option<Domain> {
    dag.deepest(a.into_iter().chain(b).collect())
}

/// A contribution made inside loop `within` to a node that lives further out is summed over the
/// loops between, but not beyond `context`. A leaf in a sum of a branch lives further in: nothing is
/// summed.
fn sum_out(
    dag: &mut Dag,
    child: Node,
    within: Option<Domain>,
    context: Option<Domain>,
    value: Node,
) -> Node {
    let home = dag.home(child);
    let stop = inner(dag, home, context);
    let mut value = value;
    let mut at = inner(dag, within, home);
    while at != stop {
        let Some(domain) = at else { break };
        let parent = dag.range(domain).parent;
        value = dag.reduce(domain, value);
        at = parent;
    }
    value
}

/// The partial derivatives of a product or a function by its factors or arguments; of a product, by
/// those that depend on `what`, and by x where a factor is (√x)ⁿ or (∛x)ⁿ with a derivative that has a
/// value where x is 0. Long products are trees by now (see `programs::balance`); of one of its pairs, a
/// derivative is the other.
fn partials(dag: &mut Dag, node: Node, what: Dependence) -> Vec<(Node, Node)> {
    let mut partials = Vec::new();
    match dag.kind(node).clone() {
        Kind::Product(k, factors) => {
            for (at, &(node, n)) in factors.iter().enumerate() {
                if !dag.dependence(node).on(what) {
                    continue;
                }
                let (child, degree) = match dag.kind(node) {
                    Kind::Call(Op::Sqrt, x) if n >= 2 => (x[0], 2),
                    Kind::Call(Op::Cbrt, x) if n >= 3 => (x[0], 3),
                    _ => (node, 1),
                };
                let mut rest = factors.clone();
                rest[at].1 = n - degree;
                if n == degree {
                    rest.remove(at);
                }
                let scale = k.mul(&Rational::new(i64::from(n), i64::from(degree)));
                partials.push((child, dag.product(&scale, &rest)));
            }
        }
        Kind::Call(op, arguments) => {
            let values = (op.row().partials)(dag, &arguments, node);
            partials.extend(arguments.into_iter().zip(values));
        }
        Kind::External(function, part, arguments) => {
            for (&child, i) in arguments.iter().zip(0..) {
                let partial = dag.external(function, part.by(i), &arguments);
                partials.push((child, partial));
            }
        }
        other => unreachable!("{other:?} is differentiated by itself"),
    }
    partials
}

/// The derivative of `root` along the direction (vq, vp): Σ ∂root/∂q·vq + ∂root/∂p·vp.
pub fn along_direction(dag: &mut Dag, root: Node) -> Node {
    let what = Dependence(Dependence::Q.0 | Dependence::P.0);
    forward(dag, root, what, |dag, leaf| {
        let (column, row) = dag.phase_place(leaf)?;
        let row = row.clone();
        Some(dag.element(Array::Direction(column), row, None))
    })
}

/// The forward sweep: the tangent of `root` when each leaf's tangent is `seed(leaf)`.
pub fn forward(
    dag: &mut Dag,
    root: Node,
    what: Dependence,
    mut seed: impl FnMut(&mut Dag, Node) -> Option<Node>,
) -> Node {
    let zero = dag.integer(0);
    let nodes = dag.reachable(&[root]);
    let tangents = dag.map(nodes, |dag, node, tangents| match dag.kind(node).clone() {
        _ if !dag.dependence(node).on(what) => zero,
        Kind::Sum(_, terms) => {
            let terms = terms
                .into_iter()
                .map(|(k, n)| (k, tangents[&n]))
                .into_list();
            dag.linear(&Rational::ZERO, &terms)
        }
        Kind::Call(Op::Min | Op::Max, _) | Kind::Select(..) => {
            let Branches { condition, yes, no } = Branches::of(dag, node);
            dag.select(condition, tangents[&yes], tangents[&no])
        }
        Kind::Product(..) | Kind::Call(..) | Kind::External(..) => {
            let parts: Vec<_> = partials(dag, node, what)
                .into_iter()
                .map(|(child, partial)| dag.mul(&[partial, tangents[&child]]))
                .into_list();
            dag.add(&parts)
        }
        Kind::Reduce(domain, body) => dag.reduce(domain, tangents[&body]),
        _ => seed(dag, node).unwrap_or(zero),
    });
    tangents[&root]
}
