//! Forces in the vector field and in kicks.
//!
//! Input: a model with its force f, and ∂H/∂q. Output: f − ∂H/∂q element by element, and [`Kick`], the
//! exact flow of ṗ = f − ∂H/∂q at frozen q where f is affine in p. Invariant: an element of the force
//! is in one entry, with the part of ∂H/∂q that belongs to the same element of the same loop.
//!
//! With f = b + a·p for each momentum by itself, a and b free of momenta, the flow for the duration c
//! is p + w·(f − ∂H/∂q) with w = (eᶜᵃ − 1)/a, which is c where a = 0.

use crate::dag::{Array, Dag, Dependence, Node, Side};
use crate::diff;
use crate::model::{Model, VectorEntry};
use crate::op::Op;
use crate::pipeline::gradient_of;

/// The exact flow of ṗ = f − ∂H/∂q at frozen q, as two accumulations, one after the other.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Kick {
    /// Reads momenta: each entry its own element alone.
    pub damped: Vec<VectorEntry>,
    /// Reads none.
    pub rest: Vec<VectorEntry>,
}

/// Where two entries add to the same element in the same iteration.
fn same_place(a: &VectorEntry, b: &VectorEntry) -> bool {
    (a.group, a.column, &a.row) == (b.group, b.column, &b.row)
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
                side: Side::P,
                value,
                ..entry.clone()
            }),
        }
    }
    slopes
}

/// ∂f/∂p of an element by its own momentum; 0 where f does not depend on momenta. An error where it
/// is not affine in its own momentum alone.
fn rate(dag: &mut Dag, force: &VectorEntry) -> Result<Node, ()> {
    let own = dag.element(
        Array::Phase {
            side: Side::P,
            group: force.group,
            column: force.column,
        },
        force.row.clone(),
        None,
    );
    match diff::gradient(dag, force.value, Dependence::P).as_slice() {
        [] if !dag.dependence(force.value).on(Dependence::P) => Ok(dag.integer(0)),
        [(leaf, rate)] if *leaf == own && !dag.dependence(*rate).on(Dependence::P) => Ok(*rate),
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

/// Whether an entry is in every row of its group.
fn is_whole(model: &Model, entry: &VectorEntry) -> bool {
    use crate::model::Shape;
    let rows = match &model.groups[usize::from(entry.group)].shape {
        Shape::Scalar => return true,
        Shape::Vector(rows) | Shape::Matrix(rows, _) => rows,
    };
    match (entry.row.affine.loops.as_slice(), &entry.row.modulo) {
        ([(domain, 1)], None) => {
            let range = model.dag.range(*domain);
            entry.row.affine.constant == 0
                && entry.row.affine.sizes.is_empty()
                && range.parent.is_none()
                && range.start.as_constant() == Some(0)
                && range.end == *rows
        }
        _ => false,
    }
}

/// The kick, from ∂V/∂q.
///
/// # Errors
/// The entry of the force whose flow at frozen q is not known: it is not affine in its own momentum, or
/// its rate is that of a row and other rows are pushed in the same loop.
pub fn kick(model: &mut Model, gradient: &[VectorEntry]) -> Result<Kick, Box<VectorEntry>> {
    let forces = model.force.clone();
    let mut weights = Vec::with_capacity(forces.len());
    for force in &forces {
        let rate = rate(&mut model.dag, force).map_err(|()| Box::new(force.clone()))?;
        let damps = !model.dag.is_zero(rate);
        weights.push((weight(&mut model.dag, rate), damps));
    }
    let mut kick = Kick::default();
    let c = model.dag.coefficient();
    for entry in slopes(model, gradient) {
        let of_same =
            |force: &VectorEntry| (force.group, force.column) == (entry.group, entry.column);
        let exact = forces.iter().position(|force| same_place(force, &entry));
        let damping = (0..forces.len()).find(|at| weights[*at].1 && of_same(&forces[*at]));
        let (weight, damps) = match (exact, damping) {
            (Some(at), _) => weights[at],
            (None, None) => (c, false),
            // Another loop pushes the same momenta: the weight must be the same in all rows.
            (None, Some(at)) => {
                let (weight, _) = weights[at];
                if model.dag.variables(weight) != 0 || !is_whole(model, &forces[at]) {
                    return Err(Box::new(forces[at].clone()));
                }
                (weight, false)
            }
        };
        let value = model.dag.mul(&[weight, entry.value]);
        let scaled = VectorEntry { value, ..entry };
        match damps {
            true => kick.damped.push(scaled),
            false => kick.rest.push(scaled),
        }
    }
    Ok(kick)
}

/// The kick of the model's H, which is separable.
///
/// # Errors
/// Those of [`kick`].
pub fn kick_of(model: &mut Model) -> Result<Kick, Box<VectorEntry>> {
    let h = model.hamiltonian.unwrap_or_else(|| model.dag.integer(0));
    let gradient = gradient_of(model, String::new(), h).entries;
    let gradient: Vec<_> = gradient
        .into_iter()
        .filter(|entry| entry.side == Side::Q)
        .collect();
    kick(model, &gradient)
}
