//! Forces in the vector field and in kicks.
//!
//! Input: a model with its force f, and ∂H/∂q. Output: f − ∂H/∂q element by element, and [`KickFlow`], the
//! exact flow of ṗ = f − ∂H/∂q at frozen q where f is affine in p. Invariant: an element of the force
//! is in one entry, with the part of ∂H/∂q that belongs to the same element of the same loop.
//!
//! With f = b + a·p for each momentum by itself, a and b free of momenta, the flow for the duration c
//! is p + w·(f − ∂H/∂q) with w = (eᶜᵃ − 1)/a, which is c where a = 0. Where momenta push each other,
//! f = b + A·p, the flow is a series in A, which a run sums: the program says A·p.

use crate::dag::{Dag, Dependence, Node, Side};
use crate::diff;
use crate::list::IntoList;
use crate::model::{Model, VectorEntry};
use crate::op::Op;
use crate::structure::degrees;

/// The exact flow of ṗ = f − ∂H/∂q at frozen q.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum KickFlow {
    /// Two accumulations, one after the other.
    Single {
        /// Reads momenta: each entry its own element alone.
        damped: Vec<VectorEntry>,
        /// Reads none.
        rest: Vec<VectorEntry>,
    },
    /// Momenta push each other.
    Coupled {
        /// c·A·p
        linear: Vec<VectorEntry>,
    },
}

/// Returns true if two entries add to the same element in the same iteration.
fn same_place(a: &VectorEntry, b: &VectorEntry) -> bool {
    (a.at.on(Side::P), &a.row) == (b.at.on(Side::P), &b.row)
}

/// f − ∂H/∂q of momenta, from ∂H/∂q.
#[must_use]
pub fn slopes(model: &mut Model, gradient: &[VectorEntry]) -> Vec<VectorEntry> {
    let mut slopes = model.force.clone();
    for entry in gradient {
        let value = model.dag.neg(entry.value);
        match slopes.iter_mut().find(|slope| same_place(slope, entry)) {
            Some(slope) => slope.value = model.dag.add(&[slope.value, value]),
            None => slopes.push(VectorEntry {
                at: entry.at.on(Side::P),
                value,
                ..entry.clone()
            }),
        }
    }
    slopes
}

/// The part of an entry that is linear in momenta, of an entry that is affine in them.
fn linear(dag: &mut Dag, force: &VectorEntry) -> VectorEntry {
    let value = diff::forward(dag, force.value, Dependence::P, |dag, leaf| {
        dag.dependence(leaf).on(Dependence::P).then_some(leaf)
    });
    VectorEntry {
        value,
        ..force.clone()
    }
}

/// ∂f/∂p of an element by its own momentum, where f is affine in momenta; 0 where it does not depend on
/// them. An error where other momenta push it.
fn rate(dag: &mut Dag, force: &VectorEntry) -> Result<Node, ()> {
    let own = dag.phase(force.at, force.row.clone());
    match diff::gradient(dag, force.value, Dependence::P).as_slice() {
        [] => Ok(dag.integer(0)),
        [(leaf, rate)] if *leaf == own => Ok(*rate),
        _ => Err(()),
    }
}

/// (eᶜᵃ − 1)/a
fn weight(dag: &mut Dag, rate: Node) -> Node {
    let c = dag.coefficient();
    if dag.is_zero(rate) {
        return c;
    }
    let exponent = dag.mul(&[c, rate]);
    let growth = dag.call(Op::ExpM1, &[exponent]);
    let weight = dag.div(growth, rate);
    if dag.as_constant(rate).is_some() {
        return weight;
    }
    let zero = dag.integer(0);
    let still = dag.equal(rate, zero);
    dag.select(still, c, weight)
}

/// Returns true if an entry is in every row of its group.
fn is_whole(model: &Model, entry: &VectorEntry) -> bool {
    let rows = model.groups[usize::from(entry.at.group)].shape.rows();
    rows.is_none_or(|rows| model.dag.loops_of_rows(&entry.row, rows).is_some())
}

/// The kick, from ∂V/∂q.
///
/// # Errors
/// The entry of the force that is not affine in momenta.
pub fn kick(model: &mut Model, gradient: &[VectorEntry]) -> Result<KickFlow, Box<VectorEntry>> {
    let forces = model.force.clone();
    // Derivatives do not decide this: that of sign(p) is 0.
    let is_affine = |f: &VectorEntry| degrees(&model.dag, f.value).is_some_and(|(_, n)| n <= 1);
    if let Some(force) = forces.iter().find(|force| !is_affine(force)) {
        return Err(Box::new(force.clone()));
    }
    Ok(single(model, gradient).unwrap_or_else(|()| {
        let c = model.dag.coefficient();
        let scaled = |force: &VectorEntry| {
            let entry = linear(&mut model.dag, force);
            let value = model.dag.mul(&[c, entry.value]);
            VectorEntry { value, ..entry }
        };
        KickFlow::Coupled {
            linear: forces.iter().map(scaled).into_list(),
        }
    }))
}

/// The kick where each momentum is pushed by itself. An error where it is not: it is pushed by others,
/// or its rate is that of a row and other rows are pushed in the same loop.
fn single(model: &mut Model, gradient: &[VectorEntry]) -> Result<KickFlow, ()> {
    let forces = model.force.clone();
    let mut weights = Vec::with_capacity(forces.len());
    for force in &forces {
        let rate = rate(&mut model.dag, force)?;
        let damps = !model.dag.is_zero(rate);
        weights.push((weight(&mut model.dag, rate), damps));
    }
    let (mut damped, mut rest) = (Vec::new(), Vec::new());
    let c = model.dag.coefficient();
    for entry in slopes(model, gradient) {
        let of_same = |force: &VectorEntry| force.at == entry.at;
        let exact = forces.iter().position(|force| same_place(force, &entry));
        let damping = (0..forces.len()).find(|at| weights[*at].1 && of_same(&forces[*at]));
        let (weight, damps) = match (exact, damping) {
            (Some(at), _) => weights[at],
            (None, None) => (c, false),
            // Another loop pushes the same momenta: the weight must be the same in all rows.
            (None, Some(at)) => {
                let (weight, _) = weights[at];
                if !model.dag.variables(weight).is_empty() || !is_whole(model, &forces[at]) {
                    return Err(());
                }
                (weight, false)
            }
        };
        let value = model.dag.mul(&[weight, entry.value]);
        let scaled = VectorEntry { value, ..entry };
        match damps {
            true => damped.push(scaled),
            false => rest.push(scaled),
        }
    }
    Ok(KickFlow::Single { damped, rest })
}

/// ∂H/∂q where the kick is of H and the force: a force beside pieces of H is a piece of its own.
#[must_use]
pub fn gradient_of_pieces(model: &mut Model) -> Vec<VectorEntry> {
    if !model.pieces.is_empty() {
        return Vec::new();
    }
    let h = model.h();
    let mut gradient = model.partials(h);
    gradient.retain(|entry| entry.at.side == Side::Q);
    gradient
}

/// The kick of the model: of its H, which is separable, and its force, or of the force alone.
///
/// # Errors
/// As for [`kick`].
pub fn kick_of(model: &mut Model) -> Result<KickFlow, Box<VectorEntry>> {
    let gradient = gradient_of_pieces(model);
    kick(model, &gradient)
}
