//! The terms of a sum in groups that have no degree of freedom in common.
//!
//! Input: terms. Output: groups of them. Invariant: an element whose row is not given by number stands for
//! all elements of its column; a term in which nothing moves is in the first group.

use crate::dag::{Column, Dag, Map, Node, Side};
use crate::list::IntoList;

/// The groups, in the order of their first terms.
pub(crate) fn components(dag: &Dag, terms: &[Node]) -> Vec<Vec<Node>> {
    let mut classes = Classes(Vec::new());
    let mut pairs: Map<(Column, Option<i64>), usize> = Map::default();
    let mut known: Map<Node, usize> = Map::default();
    for node in dag.reachable(terms) {
        let mut class = None;
        if let Some((column, row)) = dag.phase_place(node) {
            let pair = (column.on(Side::Q), row.as_constant());
            class = Some(*pairs.entry(pair).or_insert_with(|| classes.add()));
        }
        dag.for_children(node, |child| {
            if let Some(own) = known.get(&child) {
                class = Some(class.map_or(*own, |class| classes.join(class, *own)));
            }
        });
        if let Some(class) = class {
            known.insert(node, class);
        }
    }
    for ((column, _), class) in pairs.iter() {
        if let Some(all) = pairs.get(&(*column, None)) {
            classes.join(*class, *all);
        }
    }
    let mut groups: Vec<(usize, Vec<Node>)> = Vec::new();
    let mut at_rest = Vec::new();
    for &term in terms {
        let Some(class) = known.get(&term).map(|class| classes.of(*class)) else {
            at_rest.push(term);
            continue;
        };
        match groups.iter_mut().find(|(own, _)| *own == class) {
            Some((_, group)) => group.push(term),
            None => groups.push((class, vec![term])),
        }
    }
    let mut groups: Vec<Vec<Node>> = groups.into_iter().map(|(_, group)| group).into_list();
    match groups.first_mut() {
        Some(first) => first.extend(at_rest),
        None => groups.push(at_rest),
    }
    groups
}

/// Disjoint sets of numbers: each has the number of another one of its set, or of itself.
struct Classes(Vec<usize>);

impl Classes {
    fn add(&mut self) -> usize {
        self.0.push(self.0.len());
        self.0.len() - 1
    }
    fn of(&mut self, mut at: usize) -> usize {
        while self.0[at] != at {
            self.0[at] = self.0[self.0[at]];
            at = self.0[at];
        }
        at
    }
    fn join(&mut self, a: usize, b: usize) -> usize {
        let (a, b) = (self.of(a), self.of(b));
        self.0[b] = a;
        a
    }
}
