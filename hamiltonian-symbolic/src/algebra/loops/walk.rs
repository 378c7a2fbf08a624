//! A walk over an expression that runs its loops.
//!
//! Input: an arena, roots, sizes, and the [`Meaning`] of nodes. Output: the meaning of the
//! roots. Invariant: a node is visited once for each iteration of the innermost loop it depends
//! on, children first; the walk recurses only into nested loops.

use crate::dag::{Dag, Kind, Map, Node};
use crate::index::{Affine, Domain, Index, LOOPS, Size};
use crate::list::IntoList;
use std::rc::Rc;

/// The meaning of nodes to a walk.
pub(crate) trait Meaning {
    /// The image of a node.
    type Value: Clone;
    /// The meaning of a node that is not a loop, given its children's.
    fn value(
        &mut self,
        dag: &Dag,
        node: Node,
        place: &Environment,
        child: &dyn Fn(Node) -> Self::Value,
    ) -> Self::Value;
    /// The meaning of a sum over a loop, given its iterations'.
    fn total(&mut self, parts: Vec<Self::Value>) -> Self::Value;
    /// Returns true if to stop: nodes that were not visited get no meaning.
    fn is_done(&self) -> bool;
}

/// The place of a walk: the values of sizes and loop variables.
#[derive(Clone, Debug)]
pub(crate) struct Environment {
    sizes: Vec<i64>,
    variables: Vec<i64>,
}

impl Environment {
    /// Outside all loops.
    pub(crate) fn new(sizes: &[i64]) -> Environment {
        Environment {
            sizes: sizes.to_vec(),
            variables: vec![0; LOOPS],
        }
    }
    /// The value of an affine index.
    pub(crate) fn affine(&self, affine: &Affine) -> i64 {
        affine.value(&|d: Domain| self.variable(d), &|s: Size| self.size(s))
    }
    /// The value of an index.
    pub(crate) fn index(&self, index: &Index) -> i64 {
        index.value(&|d: Domain| self.variable(d), &|s: Size| self.size(s))
    }
    /// The value of a loop variable.
    pub(crate) fn variable(&self, domain: Domain) -> i64 {
        self.variables[domain.0 as usize]
    }
    /// The value of a size.
    pub(crate) fn size(&self, size: Size) -> i64 {
        self.sizes[usize::from(size.0)]
    }
    /// The number of iterations of a loop from here.
    pub(crate) fn count(&self, dag: &Dag, domain: Domain) -> i64 {
        let range = dag.range(domain);
        (self.affine(&range.end) - self.affine(&range.start)).max(0)
    }
}

struct Walk<'a, M: Meaning> {
    dag: &'a Dag,
    meaning: M,
    place: Environment,
    values: Map<Node, M::Value>,
    blocks: Map<Node, Rc<[Node]>>,
}

/// The meanings of the roots, and the meaning itself with its findings; `None` where the walk
/// was stopped.
pub(crate) fn walk<M: Meaning>(
    dag: &Dag,
    roots: &[Node],
    sizes: &[i64],
    meaning: M,
) -> (Option<Vec<M::Value>>, M) {
    let order = dag.reachable(roots);
    let homes: Map<Node, Domain> = order
        .iter()
        .filter_map(|n| dag.home(*n).map(|d| (*n, d)))
        .collect();
    let mut blocks: Map<Node, Rc<[Node]>> = Map::default();
    for &node in &order {
        if let Kind::Reduce(domain, body) = dag.kind(node) {
            blocks.insert(node, block(dag, *body, *domain, &homes).into());
        }
    }
    let outside: Vec<Node> = order
        .into_iter()
        .filter(|n| dag.variables(*n).is_empty())
        .into_list();
    let mut walk = Walk {
        dag,
        meaning,
        place: Environment::new(sizes),
        values: Map::default(),
        blocks,
    };
    walk.run(&outside);
    let values = roots
        .iter()
        .map(|root| walk.values.get(root).cloned())
        .collect();
    (
        if walk.meaning.is_done() { None } else { values },
        walk.meaning,
    )
}

/// The nodes a loop's body needs that are computed in each iteration of this loop, but not of one
/// inside it.
fn block(dag: &Dag, body: Node, domain: Domain, homes: &Map<Node, Domain>) -> Vec<Node> {
    let is_inside = |node: Node| dag.variables(node).has(domain);
    let mut found = dag.reached(&[body], &mut |node, ahead| {
        dag.for_children(node, |child| {
            if is_inside(child) {
                ahead.add(child);
            }
        });
    });
    found.retain(|node| homes.get(node) == Some(&domain));
    found
}

impl<M: Meaning> Walk<'_, M> {
    fn run(&mut self, block: &[Node]) {
        for &node in block {
            if self.meaning.is_done() {
                return;
            }
            let value = match self.dag.kind(node) {
                Kind::Reduce(domain, body) => self.run_loop(node, *domain, *body),
                _ => {
                    // Children come first in the arena.
                    let child = |child: Node| self.values[&child].clone();
                    let value = self.meaning.value(self.dag, node, &self.place, &child);
                    Some(value)
                }
            };
            if let Some(value) = value {
                self.values.insert(node, value);
            }
        }
    }

    fn run_loop(&mut self, node: Node, domain: Domain, body: Node) -> Option<M::Value> {
        let range = self.dag.range(domain);
        let (start, end) = (
            self.place.affine(&range.start),
            self.place.affine(&range.end),
        );
        let block = Rc::clone(self.blocks.get(&node)?);
        let outer = self.place.variable(domain);
        let mut parts = Vec::new();
        for at in start..end {
            self.place.variables[domain.0 as usize] = at;
            self.run(&block);
            if self.meaning.is_done() {
                return None;
            }
            parts.push(self.values.get(&body)?.clone());
        }
        self.place.variables[domain.0 as usize] = outer;
        Some(self.meaning.total(parts))
    }
}
