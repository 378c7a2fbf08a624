//! A number for each node of an arena.
//!
//! Input: nodes. Output: their numbers. Invariant: the same on every machine.

use super::{Dag, Node};

/// A number for some of an arena's nodes: a map without hashing, which is what most of the time
/// without optimisation goes into.
#[derive(Clone, Debug)]
pub(crate) struct Numbers(Vec<u32>);

impl Numbers {
    /// No numbers for the nodes that there are now.
    pub(crate) fn new(dag: &Dag) -> Numbers {
        Numbers(vec![0; dag.len()])
    }
    /// A node's number.
    pub(crate) fn get(&self, node: Node) -> Option<u32> {
        match self.0.get(node.0 as usize) {
            None | Some(0) => None,
            Some(above) => Some(above - 1),
        }
    }
    /// Returns true if a node has a number.
    pub(crate) fn has(&self, node: Node) -> bool {
        self.0.get(node.0 as usize).is_some_and(|above| *above != 0)
    }
    /// Gives a node its number.
    pub(crate) fn set(&mut self, node: Node, number: u32) {
        self.0[node.0 as usize] = number + 1;
    }
    /// Takes a node's number away.
    pub(crate) fn unset(&mut self, node: Node) {
        self.0[node.0 as usize] = 0;
    }
}
