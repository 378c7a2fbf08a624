//! Heliocentric coordinates of any number of bodies: the maps as loops over rows.
//!
//! Input: groups of n rows, n ≥ 1 a size. Output: entries of the maps; elements that are read, as
//! functions of the new ones. Invariant: row 0 is an entry of its own, rows 1 … n−1 are one in a
//! loop.

use crate::dag::{Column, Dag, Node, Side};
use crate::index::{Affine, Domain, End, Index};
use crate::model::{Model, VectorEntry};
use crate::ranges::Ranges;

/// A group of bodies whose number is a size.
#[derive(Clone, Debug)]
pub(super) struct SizedBodies {
    /// Its number in the old model.
    pub(super) old: u16,
    /// Its number in the new model.
    pub(super) new: u16,
    rows: Affine,
    columns: u16,
}

impl SizedBodies {
    /// The group, if its number of rows is not literal or more than `written_out`; both loops over it are made in the arena,
    /// so that they have the same numbers in copies of it.
    pub(super) fn new(
        model: &mut Model,
        (old, new): (u16, u16),
        written_out: i64,
    ) -> Option<SizedBodies> {
        let shape = &model.groups[usize::from(old)].shape;
        let (rows, columns) = (shape.rows()?.clone(), shape.columns());
        if rows.as_constant().is_some_and(|rows| rows <= written_out) {
            return None;
        }
        let bodies = SizedBodies {
            old,
            new,
            rows,
            columns,
        };
        bodies.all(&mut model.dag);
        bodies.others(&mut model.dag);
        Some(bodies)
    }

    /// The loop over all rows.
    pub(super) fn all(&self, dag: &mut Dag) -> Domain {
        dag.domain(None, Affine::constant(0), self.rows.clone())
    }

    /// The loop over all rows but the first.
    pub(super) fn others(&self, dag: &mut Dag) -> Domain {
        dag.domain(None, Affine::constant(1), self.rows.clone())
    }

    fn element(dag: &mut Dag, side: Side, group: u16, column: u16, row: Affine) -> Node {
        dag.phase(
            Column {
                side,
                group,
                column,
            },
            Index::plain(row),
        )
    }

    /// Both entries of a column: `first` of row 0, `other` of the rows of the loop.
    fn entries(&self, dag: &mut Dag, at: Column, first: Node, other: Node) -> [VectorEntry; 2] {
        let entry = |row, value| VectorEntry { at, row, value };
        let others = Affine::variable(self.others(dag));
        [
            entry(Index::constant(0), first),
            entry(Index::plain(others), other),
        ]
    }

    /// Q_0 = q_0, Q_i = q_i − q_0; P_0 = Σ p_k, P_i = p_i.
    pub(super) fn forward(&self, dag: &mut Dag) -> Vec<VectorEntry> {
        let (all, others) = (self.all(dag), self.others(dag));
        let mut entries = Vec::new();
        for column in 0..self.columns {
            let mut old = |side, row| Self::element(dag, side, self.old, column, row);
            let first = old(Side::Q, Affine::constant(0));
            let other = old(Side::Q, Affine::variable(others));
            let each = old(Side::P, Affine::variable(all));
            let momentum = old(Side::P, Affine::variable(others));
            let (other, total) = (dag.sub(other, first), dag.reduce(all, each));
            let q = Column {
                side: Side::Q,
                group: self.new,
                column,
            };
            entries.extend(self.entries(dag, q, first, other));
            entries.extend(self.entries(dag, q.conjugate(), total, momentum));
        }
        entries
    }

    /// q_0 = Q_0, q_i = Q_0 + Q_i; p_0 = P_0 − Σ_{i≥1} P_i, p_i = P_i.
    pub(super) fn inverse(&self, dag: &mut Dag) -> Vec<VectorEntry> {
        let others = Affine::variable(self.others(dag));
        let mut entries = Vec::new();
        for column in 0..self.columns {
            for side in [Side::Q, Side::P] {
                let first = self.first(dag, side, column);
                let other = self.other(dag, side, column, others.clone());
                let group = self.old;
                let at = Column {
                    side,
                    group,
                    column,
                };
                entries.extend(self.entries(dag, at, first, other));
            }
        }
        entries
    }

    /// q_0, p_0
    fn first(&self, dag: &mut Dag, side: Side, column: u16) -> Node {
        let own = Self::element(dag, side, self.new, column, Affine::constant(0));
        if side == Side::Q {
            return own;
        }
        let sum = self.total_of_others(dag, column);
        dag.sub(own, sum)
    }

    /// Σ_{i≥1} P_i
    fn total_of_others(&self, dag: &mut Dag, column: u16) -> Node {
        let others = self.others(dag);
        let each = Self::element(dag, Side::P, self.new, column, Affine::variable(others));
        dag.reduce(others, each)
    }

    /// q_i, p_i for i ≥ 1
    fn other(&self, dag: &mut Dag, side: Side, column: u16, row: Affine) -> Node {
        let own = Self::element(dag, side, self.new, column, row);
        if side == Side::P {
            return own;
        }
        let first = self.first(dag, side, column);
        dag.add(&[first, own])
    }

    /// The image of the element of a row that a loop reads; `None` where the row wraps around.
    pub(super) fn image(
        &self,
        dag: &mut Dag,
        all: &[SizedBodies],
        (side, column): (Side, u16),
        row: &Index,
    ) -> Option<Node> {
        if row.modulo.is_some() || row.outer.is_some() {
            return None;
        }
        let affine = &row.affine;
        if affine.as_constant() == Some(0) {
            return Some(self.first(dag, side, column));
        }
        if least(dag, affine, all).is_some_and(|least| least > 0) {
            return Some(self.other(dag, side, column, affine.clone()));
        }
        // Row 0 or another: decided where it runs.
        let (number, zero) = (dag.affine(affine), dag.integer(0));
        let is_first = dag.equal(number, zero);
        let own = Self::element(dag, side, self.new, column, affine.clone());
        Some(match side {
            Side::Q => {
                let first = self.first(dag, side, column);
                let relative = dag.select(is_first, zero, own);
                dag.add(&[first, relative])
            }
            // The sum over the others stands beside the choice, not in it: its value does not
            // depend on the row.
            Side::P => {
                let one = dag.integer(1);
                let chosen = dag.select(is_first, one, zero);
                let others = self.total_of_others(dag, column);
                let share = dag.mul(&[chosen, others]);
                dag.sub(own, share)
            }
        })
    }

    /// A force on all rows as one on row 0 and one on the others.
    pub(super) fn apart(&self, dag: &mut Dag, force: &VectorEntry) -> Vec<VectorEntry> {
        let all = self.all(dag);
        if force.at.group != self.old || force.row != Index::of_loop(all) {
            return vec![force.clone()];
        }
        let others = Affine::variable(self.others(dag));
        let first = dag.replace(force.value, all, &Affine::constant(0));
        let other = dag.replace(force.value, all, &others);
        self.entries(dag, force.at, first, other).to_vec()
    }

    /// The part of a force on old momenta ([`SizedBodies::apart`]) in that on the new ones:
    /// F_0 = Σ f_k, F_i = f_i; added to `found`.
    pub(super) fn force(&self, dag: &mut Dag, force: &VectorEntry, found: &mut Vec<VectorEntry>) {
        let others = self.others(dag);
        let moved = VectorEntry {
            at: Column {
                group: self.new,
                ..force.at
            },
            ..force.clone()
        };
        let mut to_first = force.value;
        if force.row != Index::constant(0) {
            to_first = dag.reduce(others, to_first);
            found.push(moved.clone());
        }
        let is_first =
            |entry: &&mut VectorEntry| entry.at == moved.at && entry.row == Index::constant(0);
        let of_first = found.iter_mut().find(is_first);
        match of_first {
            Some(entry) => entry.value = dag.add(&[entry.value, to_first]),
            None => found.push(VectorEntry {
                row: Index::constant(0),
                value: to_first,
                ..moved
            }),
        }
    }
}

/// A number that an index is never below, as there are bodies; `None` if it is not known.
pub(super) fn least(dag: &Dag, index: &Affine, bodies: &[SizedBodies]) -> Option<i64> {
    let counts_bodies = |size| bodies.iter().any(|of| of.rows == Affine::size(size));
    dag.extreme(index, End::Least)?.least(counts_bodies)
}
