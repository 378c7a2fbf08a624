//! An order of the pairs that follows from H alone, so that a search does not depend on the order in
//! which coordinates are listed.
//!
//! Input: expressions and the pairs that stand in them. Output: the pairs sorted by labels. Invariant:
//! a label is made from the places where a variable stands, by refinement of colours (Weisfeiler and
//! Leman 1968): neither names nor numbers of variables and parameters enter it, nor the order of
//! operands, nor a number that is added to H. Pairs of one label keep their order.

use crate::dag::{Array, Dag, Kind, Map, Mixer, Node, Side};
use crate::sort::Arrange;
use std::hash::{Hash, Hasher};

/// The most rounds: two variables that differ after none of these are taken for alike.
const ROUNDS: usize = 4;

/// Sorts pairs by their labels.
pub(super) fn sort(dag: &Dag, roots: &[Node], pairs: &mut [(Node, Node)]) {
    if pairs.len() < 2 {
        return;
    }
    let nodes = dag.reachable(roots);
    let mut colours: Map<Node, u64> = Map::default();
    for _ in 0..ROUNDS.min(pairs.len()) {
        let below = below(dag, roots, &nodes, &colours);
        let mut above = above(dag, roots, &nodes, &below);
        // Conjugate variables share what is known of them.
        for (q, p) in pairs.iter() {
            let of = |node: &Node| above.get(node).copied().unwrap_or_default();
            let (of_q, of_p) = (of(q), of(p));
            above.insert(*q, mixed(&(of_q, of_p)));
            above.insert(*p, mixed(&(of_p, of_q)));
        }
        colours = above;
    }
    let label = |node: &Node| colours.get(node).copied().unwrap_or_default();
    pairs.arrange_by_key(|(q, p)| (label(q), label(p)));
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
fn below(dag: &Dag, roots: &[Node], nodes: &[Node], leaves: &Map<Node, u64>) -> Map<Node, u64> {
    let mut colours: Map<Node, u64> = Map::default();
    for &node in nodes {
        let of = |child: &Node| colours.get(child).copied().unwrap_or_default();
        let mut own = Mixer::default();
        let kind = dag.kind(node);
        std::mem::discriminant(kind).hash(&mut own);
        match kind {
            Kind::Constant(value) => value.hash(&mut own),
            Kind::Sum(c, terms) => {
                if !roots.contains(&node) {
                    c.hash(&mut own);
                }
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
fn above(dag: &Dag, roots: &[Node], nodes: &[Node], below: &Map<Node, u64>) -> Map<Node, u64> {
    let mut colours: Map<Node, u64> = Map::default();
    for root in roots {
        colours.insert(*root, 1);
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
