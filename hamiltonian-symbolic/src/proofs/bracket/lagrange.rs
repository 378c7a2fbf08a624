//! Conservation along the motion of a Lagrangian, in velocities.
//!
//! Input: L(q, v, t) as it was solved and an expression of velocities. Output: whether its time
//! derivative vanishes. With L = ½vᵀMv + bᵀv − V the accelerations a solve Ma = F, where
//! F = ∂L/∂q − (∂p/∂q)v − ∂p/∂t and p = Mv + b; so det M·dI/dt is the determinant of M bordered by F
//! and −∂I/∂v, with (∂I/∂q)·v + ∂I/∂t in the corner: a polynomial in M, which is never inverted.
//! Invariant: M has a determinant that is not 0 everywhere (the Legendre transform saw to it).

use crate::dag::{Dag, Dependence, Map, Node, Side};
use crate::diff;
use crate::legendre::Legendre;
use crate::list::IntoList;
use crate::model::Model;
use crate::normal_form::{self, Scope};
use crate::rational::Rational;
use crate::sort::Arrange;

/// Determinants of at most this many velocities are expanded.
const MAX_VELOCITIES: usize = 6;

/// Returns true if an expression, in which velocities stand for themselves, does not
/// change along the motion. Not where loops are left.
pub(super) fn vanishes(model: &Model, legendre: &Legendre, expression: Node) -> bool {
    let mut dag = model.dag.clone();
    derivative(&mut dag, legendre, expression)
        .is_some_and(|rate| normal_form::vanishes(&mut dag, rate, Scope::Densely))
}

/// The limit that forbids the proof in velocities, if that is what does: a clause.
pub(super) fn limit(legendre: &Legendre) -> Option<String> {
    let velocities = legendre.masses.iter().map(|mass| mass.elements.len());
    (velocities.sum::<usize>() > MAX_VELOCITIES)
        .then(|| format!("a proof in velocities is tried with at most {MAX_VELOCITIES} of them"))
}

/// dI/dt times the determinant of the mass matrix.
fn derivative(dag: &mut Dag, legendre: &Legendre, expression: Node) -> Option<Node> {
    let masses = || legendre.masses.iter();
    let velocities: Vec<Node> = masses().flat_map(|mass| mass.elements.clone()).into_list();
    let has_loops = dag.has_loops(&[expression, legendre.lagrangian]);
    if velocities.len() > MAX_VELOCITIES || has_loops || masses().any(|mass| mass.domain.is_some())
    {
        return None;
    }
    let expression = in_velocities(dag, legendre, expression);
    let momenta = gradient(dag, legendre.lagrangian, Dependence::P);
    let along = gradient(dag, legendre.lagrangian, Dependence::Q);
    let zero = dag.integer(0);
    let mut matrix = Vec::new();
    let mut forces = Vec::new();
    for mass in masses() {
        let before = matrix.len();
        for row in &mass.matrix {
            let after = velocities.len() - before - row.len();
            let zeros = |n: usize| std::iter::repeat_n(zero, n);
            let row = zeros(before).chain(row.iter().copied()).chain(zeros(after));
            matrix.push(row.into_list());
        }
    }
    for velocity in &velocities {
        let momentum = momenta.get(velocity).copied().unwrap_or(zero);
        let coordinate = coordinate(dag, *velocity)?;
        let force = along.get(&coordinate).copied().unwrap_or(zero);
        let carried = carried(dag, &velocities, momentum)?;
        forces.push(dag.sub(force, carried));
    }
    let by_velocity = gradient(dag, expression, Dependence::P);
    let mut last = Vec::new();
    for velocity in &velocities {
        let slope = by_velocity.get(velocity).copied().unwrap_or(zero);
        last.push(dag.neg(slope));
    }
    last.push(carried(dag, &velocities, expression)?);
    for (row, force) in matrix.iter_mut().zip(forces) {
        row.push(force);
    }
    matrix.push(last);
    Some(determinant(dag, &matrix))
}

/// The expression with velocities in the place of momenta, and momenta as functions of them.
fn in_velocities(dag: &mut Dag, legendre: &Legendre, expression: Node) -> Node {
    let momenta: Map<Node, Node> = legendre
        .momenta
        .iter()
        .map(|momentum| (momentum.element, momentum.value))
        .collect();
    dag.substitute(expression, |dag, node| {
        let momentum = momenta.get(&node).copied();
        momentum.or_else(|| dag.momentum_in_place(node))
    })
}

/// (∂f/∂q)·v + ∂f/∂t
fn carried(dag: &mut Dag, velocities: &[Node], f: Node) -> Option<Node> {
    let by_coordinate = gradient(dag, f, Dependence::Q);
    let mut parts: Vec<(Rational, Node)> = Vec::new();
    for velocity in velocities {
        let coordinate = coordinate(dag, *velocity)?;
        if let Some(slope) = by_coordinate.get(&coordinate) {
            parts.push((Rational::ONE, dag.mul(&[*slope, *velocity])));
        }
    }
    for (_, slope) in diff::gradient(dag, f, Dependence::TIME) {
        parts.push((Rational::ONE, slope));
    }
    Some(dag.linear(&Rational::ZERO, &parts))
}

fn gradient(dag: &mut Dag, root: Node, what: Dependence) -> Map<Node, Node> {
    diff::gradient(dag, root, what).into_iter().collect()
}

/// The coordinate of a velocity.
fn coordinate(dag: &mut Dag, velocity: Node) -> Option<Node> {
    let (column, row) = dag.phase_place(velocity)?;
    let row = row.clone();
    Some(dag.phase(column.on(Side::Q), row))
}

/// The determinant, by minors of the last rows, each of which is computed once.
fn determinant(dag: &mut Dag, matrix: &[Vec<Node>]) -> Node {
    let size = matrix.len();
    let one = dag.integer(1);
    // Minors of the rows seen so far and the columns in the set.
    let mut minors: Map<u32, Node> = Map::default();
    minors.insert(0, one);
    for row in matrix.iter().rev() {
        let mut next: Map<u32, Vec<(Rational, Node)>> = Map::default();
        let mut sets: Vec<u32> = minors.keys().copied().into_list();
        sets.arrange();
        for set in sets {
            for column in (0..size).filter(|column| set >> column & 1 == 0) {
                if dag.is_zero(row[column]) {
                    continue;
                }
                // The number of columns of the minor before this one.
                let before = (set & ((1 << column) - 1)).count_ones();
                let sign = if before % 2 == 0 {
                    Rational::ONE
                } else {
                    Rational::MINUS_ONE
                };
                let product = dag.mul(&[row[column], minors[&set]]);
                next.entry(set | 1 << column)
                    .or_default()
                    .push((sign, product));
            }
        }
        let mut sets: Vec<u32> = next.keys().copied().into_list();
        sets.arrange();
        minors = Map::default();
        for set in sets {
            let sum = dag.linear(&Rational::ZERO, &next[&set]);
            minors.insert(set, sum);
        }
    }
    let all = (1 << size) - 1;
    match minors.get(&all) {
        Some(whole) => *whole,
        None => dag.integer(0),
    }
}
