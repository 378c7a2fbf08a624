//! Labels that follow from H alone, so that a search depends neither on the order in which coordinates and
//! parameters are listed nor on the order of terms.
//!
//! Input: expressions and the pairs that stand in them. Output: the pairs sorted by labels, and the labels of
//! parameters and of further expressions. Invariant: the label of a leaf is made from the places where it stands,
//! by refinement of colours (Weisfeiler and Leman 1968). Neither names nor numbers of variables and parameters
//! enter it, nor the order of operands, nor a constant that is added to H. Pairs of one label keep their order.

use crate::dag::{Array, Dag, Dependence, Kind, Map, Mixer, Node, Side};
use crate::list::IntoList;
use crate::rational::Rational;
use crate::sort::Arrange;
use std::hash::{Hash, Hasher};

/// The most rounds: two variables that differ after none of these are taken for alike.
const ROUNDS: usize = 4;

/// The labels of leaves.
pub(super) struct Labels(Map<Node, u64>);

impl Labels {
    /// The labels of the leaves of some expressions. The pairs are sorted by theirs.
    pub(super) fn new(dag: &Dag, roots: &[Node], pairs: &mut [(Node, Node)]) -> Labels {
        let terms = terms(dag, roots);
        let tops: Vec<Node> = terms.keys().copied().into_list();
        let nodes = dag.reachable(&tops);
        let is_parameter = |node: &&Node| is_parameter(dag, **node);
        let parameters: Vec<Node> = nodes.iter().filter(is_parameter).copied().into_list();
        let mut colours = Map::default();
        if pairs.len() > 1 || !parameters.is_empty() {
            colours = refined(dag, &terms, &nodes, pairs);
        }
        let label = |node: &Node| colours.get(node).copied().unwrap_or_default();
        pairs.arrange_by_key(|(q, p)| (label(q), label(p)));
        let mut labels: Map<Node, u64> = Map::default();
        for parameter in &parameters {
            labels.insert(*parameter, label(parameter));
        }
        // Pairs of one label differ from here on.
        for (at, (q, p)) in pairs.iter().enumerate() {
            labels.insert(*q, at as u64);
            labels.insert(*p, at as u64);
        }
        Labels(labels)
    }
    /// The parameters among the leaves, each with its label.
    pub(super) fn parameters(&self, dag: &Dag) -> Vec<(Node, u64)> {
        let all = self.0.iter().map(|(node, label)| (*node, *label));
        all.filter(|(node, _)| is_parameter(dag, *node)).into_list()
    }
    /// The label of an expression, whatever constant is added to it.
    pub(super) fn whole(&self, dag: &Dag, root: Node) -> u64 {
        let terms = terms(dag, &[root]);
        let tops: Vec<Node> = terms.keys().copied().into_list();
        let labels = self.of(dag, &tops);
        let terms = terms.values().zip(&labels);
        together(terms.map(|(k, label)| mixed(&(k, label))))
    }
    /// The labels of expressions over the leaves.
    pub(super) fn of(&self, dag: &Dag, roots: &[Node]) -> Vec<u64> {
        let colours = below(dag, &dag.reachable(roots), &self.0);
        roots.iter().map(|root| colours[root]).into_list()
    }
}

fn is_parameter(dag: &Dag, node: Node) -> bool {
    matches!(
        dag.kind(node),
        Kind::Scalar(_) | Kind::Element(Array::Parameter(_), ..)
    )
}

/// The colours of all nodes.
fn refined(
    dag: &Dag,
    terms: &Map<Node, Rational>,
    nodes: &[Node],
    pairs: &[(Node, Node)],
) -> Map<Node, u64> {
    let mut colours: Map<Node, u64> = Map::default();
    for _ in 0..ROUNDS.min(pairs.len().max(2)) {
        let below = below(dag, nodes, &colours);
        let mut above = above(dag, terms, nodes, &below);
        // Conjugate variables share what is known of them.
        for (q, p) in pairs.iter() {
            let of = |node: &Node| above.get(node).copied().unwrap_or_default();
            let (of_q, of_p) = (of(q), of(p));
            above.insert(*q, mixed(&(of_q, of_p)));
            above.insert(*p, mixed(&(of_p, of_q)));
        }
        colours = above;
    }
    colours
}

/// The terms of some sums, and of sums in them. A constant has no effect on what else its parameters stand for.
fn terms(dag: &Dag, roots: &[Node]) -> Map<Node, Rational> {
    let point = Dependence(Dependence::Q.0 | Dependence::P.0);
    let mut found: Map<Node, Rational> = Map::default();
    let mut left: Vec<(Rational, Node)> =
        roots.iter().map(|root| (Rational::ONE, *root)).into_list();
    while let Some((k, node)) = left.pop() {
        match dag.kind(node) {
            Kind::Sum(_, terms) => {
                left.extend(terms.iter().map(|(own, term)| (own.mul(&k), *term)))
            }
            Kind::Product(own, factors) if matches!(factors.as_slice(), [(_, 1)]) => {
                left.push((own.mul(&k), factors[0].0));
            }
            _ if dag.dependence(node).on(point) => {
                let known = found.entry(node).or_insert(Rational::ZERO);
                *known = known.add(&k);
            }
            _ => {}
        }
    }
    found
}

fn mixed(value: &impl Hash) -> u64 {
    let mut hasher = Mixer::default();
    value.hash(&mut hasher);
    // Sums of these are compared: all bits should count.
    let bits = hasher.finish();
    (bits ^ bits >> 32).wrapping_mul(0x86C2_D548_D334_43CB)
}

/// Sums of mixed values, which know no order.
fn together(values: impl Iterator<Item = u64>) -> u64 {
    values.fold(0, |sum, value| sum.wrapping_add(mixed(&value)))
}

/// The colour of each node by what stands below it.
fn below(dag: &Dag, nodes: &[Node], leaves: &Map<Node, u64>) -> Map<Node, u64> {
    let mut colours: Map<Node, u64> = Map::default();
    for &node in nodes {
        let of = |child: &Node| colours.get(child).copied().unwrap_or_default();
        let mut own = Mixer::default();
        let kind = dag.kind(node);
        std::mem::discriminant(kind).hash(&mut own);
        match kind {
            Kind::Constant(value) => value.hash(&mut own),
            Kind::Sum(c, terms) => {
                c.hash(&mut own);
                let terms = terms.iter().map(|(k, term)| mixed(&(k, of(term))));
                together(terms).hash(&mut own);
            }
            Kind::Product(k, factors) => {
                k.hash(&mut own);
                let factors = factors.iter().map(|(base, n)| mixed(&(n, of(base))));
                together(factors).hash(&mut own);
            }
            Kind::And(a, b) | Kind::Or(a, b) => together([of(a), of(b)].into_iter()).hash(&mut own),
            Kind::Call(op, arguments) => {
                op.hash(&mut own);
                arguments.iter().for_each(|x| of(x).hash(&mut own));
            }
            Kind::Compare(relation, a, b) => (relation, of(a), of(b)).hash(&mut own),
            Kind::Element(Array::Phase(column), ..) => {
                (column.side == Side::Q, leaves.get(&node)).hash(&mut own);
            }
            Kind::Scalar(_) | Kind::Element(..) => leaves.get(&node).hash(&mut own),
            _ => dag.for_children(node, |child| of(&child).hash(&mut own)),
        }
        colours.insert(node, own.finish());
    }
    colours
}

/// The colour of each node by what it stands in, and where.
fn above(
    dag: &Dag,
    terms: &Map<Node, Rational>,
    nodes: &[Node],
    below: &Map<Node, u64>,
) -> Map<Node, u64> {
    let mut colours: Map<Node, u64> = Map::default();
    for (term, k) in terms.iter() {
        colours.insert(*term, mixed(k));
    }
    for &node in nodes.iter().rev() {
        let own = (
            colours.get(&node).copied().unwrap_or_default(),
            below[&node],
        );
        let mut add = |child: Node, place: u64| {
            let colour = colours.entry(child).or_default();
            *colour = colour.wrapping_add(mixed(&(own, place)));
        };
        match dag.kind(node) {
            Kind::Sum(_, terms) => terms.iter().for_each(|(k, term)| add(*term, mixed(k))),
            Kind::Product(_, factors) => factors.iter().for_each(|(base, n)| add(*base, mixed(n))),
            Kind::And(a, b) | Kind::Or(a, b) => {
                add(*a, 0);
                add(*b, 0);
            }
            _ => {
                let mut place = 0;
                dag.for_children(node, |child| {
                    add(child, place);
                    place += 1;
                });
            }
        }
    }
    for (node, colour) in colours.iter_mut() {
        *colour = mixed(&(*colour, below[node]));
    }
    colours
}
