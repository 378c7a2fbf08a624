//! Quadratic forms inverted.
//!
//! Input: a symmetric matrix M and a vector w. Output: ½wᵀM⁻¹w and M⁻¹w. Invariant: M = PLDLᵀPᵀ is
//! taken apart with pivots that are not identically 0, for no element, plainest first, 2×2 where the
//! diagonal is 0; nothing is multiplied out, so that entries stay as compact as the source had them.

use super::elements::zero_at;
use crate::dag::{Dag, Node, Stage};
use crate::index::{Affine, Domain};
use crate::list::IntoList;
use crate::model::Model;
use crate::normal_form::{Proof, is_zero};
use crate::rational::Rational;
use crate::sort::Arrange;

/// M and w.
#[derive(Debug)]
pub(super) struct QuadraticForm {
    pub(super) matrix: Vec<Vec<Node>>,
    pub(super) right: Vec<Node>,
    /// The loop over elements, if there is a matrix for each.
    pub(super) domain: Option<Domain>,
}

/// ½wᵀM⁻¹w and M⁻¹w.
#[derive(Debug)]
pub(super) struct Solved {
    pub(super) energy: Node,
    pub(super) velocities: Vec<Node>,
    /// The rows in the order of their pivots, if these were single.
    pub(super) order: Option<Vec<usize>>,
}

/// Why there is no inverse.
#[derive(Debug)]
pub(super) enum Singular {
    /// Rows of zeros.
    Empty(Vec<usize>),
    /// Rows that were left without a pivot.
    Dependent(Vec<usize>),
    /// The last row has no pivot for one element.
    Element {
        row: usize,
        at: Affine,
        /// True if it is coupled to no other row.
        is_alone: bool,
    },
    /// Whatever the order, some pivot is 0 for some element, as this row's is for this one.
    NoOrder { row: usize, at: Affine },
}

/// One step of the elimination.
enum Pivot {
    /// Row i by its diagonal entry.
    One(usize),
    /// Rows i and j by the entry they share, their diagonal entries being 0.
    Two(usize, usize),
}

impl QuadraticForm {
    /// Solves the form.
    pub(super) fn solve(mut self, model: &mut Model) -> Result<Solved, Singular> {
        let count = self.right.len();
        let empty: Vec<usize> = (0..count)
            .filter(|i| {
                self.matrix[*i]
                    .iter()
                    .all(|entry| model.dag.is_zero(*entry))
            })
            .into_list();
        if !empty.is_empty() {
            return Err(Singular::Empty(empty));
        }
        let mut rest: Vec<usize> = (0..count).into_list();
        let mut pivots = Vec::new();
        let mut terms: Vec<(Rational, Node)> = Vec::new();
        while !rest.is_empty() {
            let Some(pivot) = self.pivot(model, &rest) else {
                return Err(self.singular(model, rest));
            };
            let dag = &mut model.dag;
            match pivot {
                Pivot::One(i) => {
                    rest.retain(|other| *other != i);
                    let d = self.matrix[i][i];
                    terms.push((
                        Rational::new(1, 2),
                        dag.product(&Rational::ONE, &[(self.right[i], 2), (d, -1)]),
                    ));
                    for (at, &j) in rest.iter().enumerate() {
                        let factor = dag.div(self.matrix[i][j], d);
                        self.right[j] = minus(dag, self.right[j], &[(factor, self.right[i])]);
                        for &k in &rest[at..] {
                            let entry =
                                minus(dag, self.matrix[j][k], &[(factor, self.matrix[i][k])]);
                            (self.matrix[j][k], self.matrix[k][j]) = (entry, entry);
                        }
                    }
                }
                Pivot::Two(i, j) => {
                    rest.retain(|other| *other != i && *other != j);
                    let c = self.matrix[i][j];
                    terms.push((
                        Rational::ONE,
                        dag.product(
                            &Rational::ONE,
                            &[(self.right[i], 1), (self.right[j], 1), (c, -1)],
                        ),
                    ));
                    for (at, &l) in rest.iter().enumerate() {
                        let (a, b) = (dag.div(self.matrix[l][i], c), dag.div(self.matrix[l][j], c));
                        self.right[l] = minus(
                            dag,
                            self.right[l],
                            &[(a, self.right[j]), (b, self.right[i])],
                        );
                        for &k in &rest[at..] {
                            let entry = minus(
                                dag,
                                self.matrix[l][k],
                                &[(a, self.matrix[j][k]), (b, self.matrix[i][k])],
                            );
                            (self.matrix[l][k], self.matrix[k][l]) = (entry, entry);
                        }
                    }
                }
            }
            pivots.push((pivot, rest.clone()));
        }
        let velocities = self.back(&mut model.dag, &pivots);
        let order = pivots.iter().map(|(pivot, _)| match pivot {
            Pivot::One(i) => Some(*i),
            Pivot::Two(..) => None,
        });
        Ok(Solved {
            order: order.collect(),
            energy: model.dag.linear(&Rational::ZERO, &terms),
            velocities,
        })
    }

    /// The next pivot: of the diagonal entries that are not 0 the one known earliest, coupled to
    /// fewest others.
    fn pivot(&self, model: &Model, rest: &[usize]) -> Option<Pivot> {
        let coupled = |i: usize| {
            rest.iter()
                .filter(|j| **j != i && !model.dag.is_zero(self.matrix[i][**j]))
                .count()
        };
        let mut order: Vec<(Stage, usize, usize)> = rest
            .iter()
            .map(|&i| (model.dag.stage(self.matrix[i][i]), coupled(i), i))
            .into_list();
        order.arrange();
        let usable = |entry: Node| !self.vanishes(model, entry);
        if let Some((_, _, i)) = order.iter().find(|(_, _, i)| usable(self.matrix[*i][*i])) {
            return Some(Pivot::One(*i));
        }
        // Two rows at a time are eliminated as if their diagonal entries were 0.
        let is_empty = |i: usize| is_zero(model, self.matrix[i][i]) == Proof::Zero;
        if !rest.iter().all(|i| is_empty(*i)) {
            return None;
        }
        rest.iter().enumerate().find_map(|(at, &i)| {
            rest[at + 1..]
                .iter()
                .find(|j| usable(self.matrix[i][**j]))
                .map(|&j| Pivot::Two(i, j))
        })
    }

    /// Returns true if an entry is identically 0, be it for one element.
    fn vanishes(&self, model: &Model, entry: Node) -> bool {
        is_zero(model, entry) == Proof::Zero || self.zero_at(model, entry).is_some()
    }

    fn zero_at(&self, model: &Model, entry: Node) -> Option<Affine> {
        self.domain.and_then(|k| zero_at(model, entry, k))
    }

    /// Why none of these rows has a pivot.
    fn singular(&self, model: &Model, rest: Vec<usize>) -> Singular {
        let entries = rest
            .iter()
            .flat_map(|i| rest.iter().map(move |j| (*i, self.matrix[*i][*j])));
        let found = entries
            .filter(|(_, entry)| is_zero(model, *entry) != Proof::Zero)
            .find_map(|(row, entry)| self.zero_at(model, entry).map(|at| (row, at)));
        match found {
            None => Singular::Dependent(rest),
            Some((row, at)) if rest.len() == 1 => Singular::Element {
                row,
                at,
                is_alone: (0..self.right.len())
                    .all(|j| j == row || model.dag.is_zero(self.matrix[row][j])),
            },
            Some((row, at)) => Singular::NoOrder { row, at },
        }
    }

    /// M⁻¹w, last pivot first: the matrix still holds each pivot's row as it was then.
    fn back(&self, dag: &mut Dag, pivots: &[(Pivot, Vec<usize>)]) -> Vec<Node> {
        let mut velocities = self.right.clone();
        for (pivot, rest) in pivots.iter().rev() {
            let mut without = |row: usize, velocities: &[Node]| {
                let products: Vec<(Node, Node)> = rest
                    .iter()
                    .map(|k| (self.matrix[row][*k], velocities[*k]))
                    .into_list();
                minus(dag, self.right[row], &products)
            };
            match *pivot {
                Pivot::One(i) => {
                    let left = without(i, &velocities);
                    velocities[i] = dag.div(left, self.matrix[i][i]);
                }
                Pivot::Two(i, j) => {
                    let (of_i, of_j) = (without(i, &velocities), without(j, &velocities));
                    velocities[i] = dag.div(of_j, self.matrix[i][j]);
                    velocities[j] = dag.div(of_i, self.matrix[i][j]);
                }
            }
        }
        velocities
    }
}

/// a − Σ x·y
fn minus(dag: &mut Dag, a: Node, products: &[(Node, Node)]) -> Node {
    let mut terms = vec![(Rational::ONE, a)];
    for (x, y) in products {
        terms.push((Rational::MINUS_ONE, dag.mul(&[*x, *y])));
    }
    dag.linear(&Rational::ZERO, &terms)
}
