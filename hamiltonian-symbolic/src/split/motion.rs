//! An exact flow as expressions: the values of the variables after the time of the step coefficient.
//!
//! Input: made by the rows. Output: [`Motion`], its composition with another, and its updates in
//! a program. Invariant: values are functions of the point before the motion; outside the
//! conditions everything that moves becomes NaN.

use super::space::{Set, Space};
use crate::dag::{Dag, Node};
use crate::op::Op;
use crate::program::Target;
use crate::schedule::Store;

/// A variable that moves.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Move {
    /// The element of coordinates or momenta.
    pub leaf: Node,
    /// The number added to it, or its new value.
    pub value: Node,
    /// Whether the value is added.
    pub added: bool,
}

/// An exact flow.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Motion {
    /// One move of each variable that moves.
    pub moves: Vec<Move>,
    /// Conditions that hold where the flow exists for the whole time.
    pub domain: Vec<Node>,
}

impl Motion {
    /// Adds to the increment of a variable.
    pub(crate) fn add(&mut self, dag: &mut Dag, leaf: Node, value: Node) {
        if dag.is_zero(value) {
            return;
        }
        match self.moves.iter_mut().find(|m| m.leaf == leaf) {
            Some(known) => known.value = dag.add(&[known.value, value]),
            None => self.moves.push(Move {
                leaf,
                value,
                added: true,
            }),
        }
    }
    /// Sets a variable.
    pub(crate) fn set(&mut self, leaf: Node, value: Node) {
        self.moves.push(Move {
            leaf,
            value,
            added: false,
        });
    }
    /// Adds a condition.
    pub(crate) fn asks(&mut self, dag: &mut Dag, positive: Node) {
        let zero = dag.integer(0);
        let holds = dag
            .as_constant(positive)
            .is_some_and(|c| !c.is_negative() && !c.is_zero());
        if !holds {
            self.domain.push(dag.less(zero, positive));
        }
    }
    /// Every variable that moves, with its new value.
    #[must_use]
    pub fn images(&self, dag: &mut Dag) -> Vec<(Node, Node)> {
        let image = |m: &Move| match m.added {
            true => (m.leaf, dag.add(&[m.leaf, m.value])),
            false => (m.leaf, m.value),
        };
        self.moves.iter().map(image).collect()
    }
    /// The variables that move.
    pub(crate) fn moved(&self, space: &mut Space) -> Set {
        self.moves.iter().fold(0, |set, m| set | space.set(m.leaf))
    }

    /// The same motion in other variables.
    pub(crate) fn map(mut self, mut image: impl FnMut(Node) -> Node) -> Motion {
        for m in &mut self.moves {
            (m.leaf, m.value) = (image(m.leaf), image(m.value));
        }
        for condition in &mut self.domain {
            *condition = image(*condition);
        }
        self
    }

    /// This motion, then another.
    pub(crate) fn then(mut self, space: &mut Space, other: &Motion) -> Motion {
        let images = self.images(space.dag());
        for next in &other.moves {
            let value = space.at(next.value, &images);
            match self.moves.iter_mut().find(|m| m.leaf == next.leaf) {
                Some(known) if next.added => {
                    known.value = space.dag().add(&[known.value, value]);
                }
                Some(known) => {
                    known.value = value;
                    known.added = false;
                }
                None => self.moves.push(Move { value, ..*next }),
            }
        }
        for &condition in &other.domain {
            let condition = space.at(condition, &images);
            if !self.domain.contains(&condition) {
                self.domain.push(condition);
            }
        }
        self
    }

    /// The updates of a program: one a variable, all values from the point before.
    #[must_use]
    pub fn stores(&self, dag: &mut Dag) -> Vec<Store> {
        let guard = self
            .domain
            .split_first()
            .map(|(first, rest)| rest.iter().fold(*first, |all, next| dag.and(all, *next)));
        let minus = dag.integer(-1);
        let nan = dag.call(Op::Sqrt, &[minus]);
        let mut stores = Vec::with_capacity(self.moves.len());
        for m in &self.moves {
            let Some((column, row)) = dag.phase_place(m.leaf) else {
                continue;
            };
            let (target, row) = (Target::Phase(column), row.clone());
            stores.push(Store {
                target,
                row,
                column: None,
                value: match guard {
                    Some(guard) => dag.select(guard, m.value, nan),
                    None => m.value,
                },
                add: m.added,
            });
        }
        stores
    }
}
