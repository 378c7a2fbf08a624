//! Tables by node.
//!
//! Input: nodes, or anything that can be hashed. Output: maps that are fast without optimisation too.
//! Invariant: the same on every machine.

use super::{Dag, Node};
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// A small multiplicative hasher: fast without optimisation, and the same on every machine.
#[derive(Default)]
pub struct Mixer(u64);
impl Hasher for Mixer {
    fn finish(&self) -> u64 {
        self.0
    }
    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.write_u64(u64::from(byte));
        }
    }
    fn write_u8(&mut self, value: u8) {
        self.write_u64(u64::from(value));
    }
    fn write_u16(&mut self, value: u16) {
        self.write_u64(u64::from(value));
    }
    fn write_u32(&mut self, value: u32) {
        self.write_u64(u64::from(value));
    }
    fn write_i32(&mut self, value: i32) {
        self.write_u64(value as u64);
    }
    fn write_i64(&mut self, value: i64) {
        self.write_u64(value as u64);
    }
    fn write_usize(&mut self, value: usize) {
        self.write_u64(value as u64);
    }
    fn write_u64(&mut self, value: u64) {
        self.0 = (self.0.rotate_left(5) ^ value).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    }
}

/// A hash map with the fixed hasher; never iterated where order could show.
pub type Map<K, V> = HashMap<K, V, BuildHasherDefault<Mixer>>;

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
