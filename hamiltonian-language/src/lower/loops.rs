//! Loops of sums, and the rows of a force: their nesting, the expressions that depend on them, and
//! the loops that are unrolled.
//!
//! Input: [`Checked`]. Output: [`Loops`]. Invariants: a loop is unrolled only where its variable
//! chooses a component that exists by number alone (a column of `q[N][3]`, an entry of `[a, b,
//! c]`); the remaining loops on which an expression depends lie on one path of parents, all of
//! which remain. [`Loops::numbers`] of an expression contains all unrolled loops whose values are
//! necessary to evaluate it, including those of its operands, except the loops of its own sums.

use crate::ast::{BinaryOp, UnaryOp};
use crate::checked::{Checked, Extent, Node, NodeId, NodeKind, Type};
use crate::names::Builtin;
use hamiltonian_symbolic::index::Domain;

/// A set of loops of the definition; there are at most `LOOPS`.
pub type Set = hamiltonian_symbolic::set::Set<Domain>;

/// Facts of loops.
#[derive(Debug)]
pub struct Loops {
    /// The loops each node depends on.
    free: Vec<Set>,
    /// True if components of a node (of its rows, for matrices) can be chosen by literal numbers
    /// only.
    by_number: Vec<bool>,
    /// The loop around each remaining loop, if the loop depends on it.
    parents: Vec<Option<Domain>>,
    /// The depth of each loop.
    depths: Vec<u32>,
    /// The unrolled loops.
    unrolled: Set,
    /// The unrolled loops on which each loop depends: itself, or those that its bounds and the
    /// bounds of the loops around it contain.
    numbers: Vec<Set>,
}

impl Loops {
    /// Reads a definition with at most `LOOPS` loops.
    pub fn of(checked: &Checked) -> Loops {
        let count = checked.loops.len();
        let mut loops = Loops {
            free: Vec::with_capacity(checked.nodes.len()),
            by_number: Vec::with_capacity(checked.nodes.len()),
            parents: vec![None; count],
            depths: vec![0; count],
            unrolled: Set::default(),
            numbers: vec![Set::default(); count],
        };
        for node in &checked.nodes {
            let free = loops.free_of(checked, node);
            loops.free.push(free);
            let by_number = loops.is_by_number(checked, node);
            loops.by_number.push(by_number);
        }
        let mut around = None;
        for (axis, id) in checked.force_rows.iter().copied().enumerate() {
            let number = id.0 as usize;
            let is_literal = checked.loops[number].upper.as_constant().is_some();
            let is_column = axis > 0 && !checked.groups[0].is_lattice;
            if is_column || !checked.charts.is_empty() && is_literal {
                loops.unrolled |= Set::of(id);
            }
            if loops.is_unrolled(id) {
                loops.numbers[number] = Set::of(id);
                continue;
            }
            loops.depths[number] = axis as u32;
            loops.parents[number] = around;
            around = Some(id);
        }
        // Bounds of a loop that is unrolled are numbers; they read only loops before it.
        for (at, one) in checked.loops.iter().enumerate().rev() {
            if loops.is_unrolled(Domain(at as u32)) {
                loops.unrolled |= one.lower.variables() | one.upper.variables();
            }
        }
        for (at, node) in checked.nodes.iter().enumerate().rev() {
            if let NodeKind::Sum { loops: own, .. } = &node.kind {
                let mut parent = loops.deepest(loops.free[at].without(loops.unrolled));
                for id in own.clone().map(Domain) {
                    let number = id.0 as usize;
                    if loops.is_unrolled(id) {
                        loops.numbers[number] = Set::of(id);
                        continue;
                    }
                    let bounds = &checked.loops[number];
                    let own = bounds.lower.variables() | bounds.upper.variables();
                    let around = parent.map(|p| loops.numbers[p.0 as usize]);
                    loops.numbers[number] = own & loops.unrolled | around.unwrap_or_default();
                    loops.depths[number] = parent.map_or(0, |p| loops.depths[p.0 as usize] + 1);
                    loops.parents[number] = parent;
                    parent = Some(id);
                }
            }
        }
        loops
    }

    fn free_of(&self, checked: &Checked, node: &Node) -> Set {
        let mut set = Set::default();
        node.kind.for_each_child(|child| set |= self.free(child));
        match &node.kind {
            NodeKind::Loop(id) => set |= Set::of(*id),
            NodeKind::Index { index, .. } => set |= index.variables(),
            NodeKind::Sum { loops, .. } => {
                for id in loops.clone() {
                    let one = &checked.loops[id as usize];
                    set |= one.lower.variables() | one.upper.variables();
                }
                set = set.without(loops.clone().map(Domain).collect());
            }
            _ => {}
        }
        set
    }

    fn is_by_number(&mut self, checked: &Checked, node: &Node) -> bool {
        let of = |child: NodeId| self.by_number[child.0 as usize];
        match &node.kind {
            // Columns of coordinates are separate arrays.
            NodeKind::Phase(_, group) => {
                let is_lattice = checked.groups[group.0 as usize].is_lattice;
                matches!(node.ty, Type::Matrix(..)) && !is_lattice
            }
            NodeKind::Vector(_) | NodeKind::Call(Builtin::Cross, _) => true,
            NodeKind::Index { base, index } => {
                let base_by_number = of(*base);
                if base_by_number && matches!(checked.node(*base).ty, Type::Vector(_)) {
                    self.unrolled |= index.variables();
                }
                base_by_number
            }
            NodeKind::Binary(BinaryOp::Mul, a, b) => {
                match (checked.node(*a).ty, checked.node(*b).ty) {
                    (Type::Matrix(..), Type::Vector(_)) => false,
                    _ => of(*a) || of(*b),
                }
            }
            NodeKind::Unary(UnaryOp::Neg, a) => of(*a),
            NodeKind::Binary(BinaryOp::Add | BinaryOp::Sub | BinaryOp::Div, a, b) => {
                of(*a) || of(*b)
            }
            // A sum is formed for each component.
            NodeKind::Sum { body, .. } => {
                of(*body) || matches!(node.ty, Type::Vector(Extent::Literal(_)))
            }
            NodeKind::If {
                then, otherwise, ..
            } => of(*then) || of(*otherwise),
            _ => false,
        }
    }

    /// The loops a node depends on.
    pub fn free(&self, node: NodeId) -> Set {
        self.free[node.0 as usize]
    }

    /// The unrolled loops on which a node depends, directly or by the range of a loop on which it
    /// depends.
    pub fn numbers(&self, node: NodeId) -> Set {
        let free = self.free(node).members();
        free.fold(Set::default(), |set, id| set | self.numbers[id.0 as usize])
    }

    /// Returns true if components of a vector can be chosen by literal numbers only.
    pub fn by_number(&self, node: NodeId) -> bool {
        self.by_number[node.0 as usize]
    }

    /// The loop around a loop, if neither is unrolled.
    pub fn parent(&self, id: Domain) -> Option<Domain> {
        self.parents[id.0 as usize]
    }

    /// Returns true if a loop is unrolled.
    pub fn is_unrolled(&self, id: Domain) -> bool {
        self.unrolled.has(id)
    }

    /// The innermost of loops that lie on one path.
    pub fn deepest(&self, set: Set) -> Option<Domain> {
        set.members().max_by_key(|id| self.depths[id.0 as usize])
    }
}
