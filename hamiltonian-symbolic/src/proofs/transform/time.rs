//! Another time: `dt = g(q, p)*ds`.
//!
//! Input: a model with H(q, p, t) and g(q, p, t) > 0. Output: [`Retimed`], the same orbits run
//! through in the time s, with t carried along as one more coordinate.
//!
//! K(q, t, p, p_t) = g·(H(q, p, t) + p_t) on the extended phase space, where t is a coordinate and
//! p_t its momentum. K is conserved, and on the shell K = 0, which is p_t = −H, its equations are
//! dq/ds = g ∂H/∂p, dp/ds = −g ∂H/∂q, dt/ds = g, dp_t/ds = −g ∂H/∂t. Off the shell the terms
//! (H + p_t)·∇g do not vanish: a start must have p_t = −H(q, p, t) ([`Retimed::start`]).
//!
//! The state's own `t` is s in the new system, which does not depend on it. Sources: Mino, Phys.
//! Rev. D 67, 084027 (2003), doi:10.1103/PhysRevD.67.084027 (g = Σ for Kerr); Sundman, Acta Math.
//! 36, 105 (1912), doi:10.1007/BF02422379 (g = r for Kepler); Hairer, Lubich & Wanner, Geometric
//! Numerical Integration, 2nd ed. 2006, §VIII.2 for the extended Hamiltonian (there with −p_t).
//! Invariant: no node of the new model is the time leaf, and the time group comes last.

use super::NoTransform;
use crate::dag::{Array, Column, Dag, Dependence, Kind, Node, Side};
use crate::diff;
use crate::index::Index;
use crate::list::IntoList;
use crate::loops::field::{elements, field};
use crate::loops::guarded;
use crate::model::{Group, Model, VectorEntry};
use crate::product::Product;
use crate::rational::Rational;

/// A system in another time.
#[derive(Clone, Debug)]
pub struct Retimed {
    /// The system in the time s: H is K, the groups are those of the old system and then
    /// (t; p_t); observables and vector functions are the same, t read from the new coordinate.
    pub model: Model,
    /// The number of the group (t; p_t).
    pub group: u16,
    /// H(q, p, t) of the old system, which is no longer the conserved quantity K.
    pub energy: Node,
    /// p_t of a start: −H(q, p, t).
    pub start: Node,
}

/// The system of `model` in the time s with dt = g ds, where g is the factor of the model. Pieces of
/// H become pieces of K: g times each, and g·p_t last. A force becomes g·f on each momentum, and
/// −g Σ f·∂H/∂p on p_t, which keeps p_t = −H while the force does work.
///
/// The new coordinate has the declared name of time, or `t`; its momentum is `p_t`; where these are
/// taken, a number follows.
///
/// # Errors
/// [`NoTransform::Factor`] if there is no g, or g is 0 or depends on something other than coordinates,
/// momenta, time and parameters. [`NoTransform::Power`] where ∂H/∂p of an array on which a force acts is
/// not known element by element.
pub fn retime(model: &Model) -> Result<Retimed, NoTransform> {
    let Some(g) = model.factor else {
        return Err(NoTransform::Factor {
            reason: "is missing",
        });
    };
    if model.dag.is_zero(g) {
        return Err(NoTransform::Factor { reason: "is 0" });
    }
    if model.dag.sign(g).is_nonpositive() {
        return Err(NoTransform::Factor {
            reason: "is never positive, so that time runs backwards or stands still",
        });
    }
    let known = Dependence(Dependence::MOVING.0 | Dependence::PARAMETER.0);
    let strange = Dependence(!known.0);
    if model.dag.dependence(g).on(strange) {
        return Err(NoTransform::Factor {
            reason: "is no function of coordinates, momenta, time and parameters",
        });
    }
    if !model.dag.variables(g).is_empty() {
        return Err(NoTransform::Factor {
            reason: "depends on a loop variable",
        });
    }
    let mut new = model.clone();
    let group = new.groups.len() as u16;
    let wanted = new.time_name().to_owned();
    new.time = None;
    let coordinate = free(&new, &wanted);
    let momentum = free(&new, &format!("p_{wanted}"));
    new.groups.push(Group::scalar(coordinate, momentum));
    new.evolution = Some(free(&new, "s"));

    let time = new.scalar(Side::Q, usize::from(group));
    let p_t = new.scalar(Side::P, usize::from(group));
    let mut roots = new.roots();
    for root in &mut roots {
        let is_time = |dag: &mut Dag, node| (*dag.kind(node) == Kind::Time).then_some(time);
        *root = new.dag.substitute(*root, is_time);
    }
    new.set_roots(&roots);
    let (factor, energy) = (new.factor.unwrap_or(g), new.h());
    let start = new.dag.neg(energy);
    let dag = &mut new.dag;
    new.hamiltonian = Some(product(dag, factor, energy, p_t));
    if !new.split.is_empty() {
        let zero = dag.integer(0);
        for piece in &mut new.split {
            *piece = product(dag, factor, *piece, zero);
        }
        new.split.push(dag.mul(&[factor, p_t]));
    }
    if !new.force.is_empty() {
        force(&mut new, factor, energy, group)?;
    }
    Ok(Retimed {
        model: new,
        group,
        energy,
        start,
    })
}

/// g times the force, and its work on p_t.
fn force(model: &mut Model, factor: Node, energy: Node, group: u16) -> Result<(), NoTransform> {
    let leaves = diff::gradient(&mut model.dag, energy, Dependence::P);
    let mut force = std::mem::take(&mut model.force);
    let mut work = Vec::new();
    for entry in &mut force {
        let velocity = velocity(model, &leaves, entry)?;
        let dag = &mut model.dag;
        let mut power = dag.mul(&[factor, entry.value, velocity]);
        let loops = dag.path(dag.deepest(entry.row.variables()));
        for domain in loops.into_iter().rev() {
            power = dag.reduce(domain, power);
        }
        work.push((Rational::MINUS_ONE, power));
        entry.value = dag.mul(&[factor, entry.value]);
    }
    force.push(VectorEntry {
        at: Column::first(Side::P, group),
        row: Index::constant(0),
        value: model.dag.linear(&Rational::ZERO, &work),
    });
    model.force = force;
    Ok(())
}

/// ∂H/∂p of the momentum that an entry of a force acts on, by the derivatives of H.
fn velocity(
    model: &mut Model,
    leaves: &[(Node, Node)],
    entry: &VectorEntry,
) -> Result<Node, NoTransform> {
    let at = entry.at.on(Side::P);
    let group = usize::from(at.group);
    let Some(rows) = model.groups[group].shape.rows().cloned() else {
        let momentum = model.scalar(Side::P, group);
        let found = leaves.iter().find(|(leaf, _)| *leaf == momentum);
        return Ok(found.map_or_else(|| model.dag.integer(0), |(_, slope)| *slope));
    };
    // A neighbour's momentum is read under a condition, where it need not exist.
    let found = field(&mut model.dag, leaves, Array::Phase(at), &rows);
    let found = found.and_then(|found| guarded(model, found, &|_| false));
    if model.dag.has_too_many_loops() {
        return Err(NoTransform::TooManyLoops);
    }
    let own = elements(&mut model.dag, &rows);
    let found = found.and_then(|found| model.dag.reindexed(found, own, &entry.row));
    found.ok_or_else(|| NoTransform::Power {
        momentum: model.groups[group].momentum.clone(),
    })
}

/// The name, or the name with the first number that makes it free.
fn free(model: &Model, name: &str) -> String {
    let mut candidate = name.to_owned();
    let mut number = 2u32;
    while model.declares(&candidate) {
        candidate = format!("{name}_{number}");
        number += 1;
    }
    candidate
}

/// g·(h + p): terms of h that have g, or a factor of it, below their fraction line meet it there;
/// the others stay in the bracket.
fn product(dag: &mut Dag, g: Node, h: Node, p: Node) -> Node {
    let factors = Product::of(dag, g).factors.into_iter();
    let factors: Vec<Node> = factors
        .filter(|(_, n)| *n > 0)
        .map(|(node, _)| node)
        .into_list();
    let mut cancelled: Vec<(Rational, Node)> = Vec::new();
    let mut bracket: Vec<(Rational, Node)> = Vec::new();
    let mut stack = vec![(Rational::ONE, h)];
    while let Some((k, node)) = stack.pop() {
        // A node without cancellation keeps its grouping.
        if !meets(dag, node, &factors) {
            bracket.push((k, node));
            continue;
        }
        match dag.kind(node) {
            Kind::Sum(c, terms) => {
                let inner = terms.iter().map(|(own, n)| (k.mul(own), *n));
                let mut inner = inner.into_list();
                if !c.is_zero() {
                    let constant = k.mul(c);
                    inner.push((constant, dag.integer(1)));
                }
                stack.extend(inner.into_iter().rev());
            }
            Kind::Product(own, parts) => match parts.as_slice() {
                [(inner, 1)] => stack.push((k.mul(own), *inner)),
                _ => {
                    let term = dag.mul(&[g, node]);
                    cancelled.push((k, term));
                }
            },
            _ => bracket.push((k, node)),
        }
    }
    bracket.push((Rational::ONE, p));
    let bracket = dag.linear(&Rational::ZERO, &bracket);
    let rest = dag.mul(&[g, bracket]);
    cancelled.push((Rational::ONE, rest));
    dag.linear(&Rational::ZERO, &cancelled)
}

/// Returns true if a term of a node, down through its sums, has one of the factors below its fraction line.
fn meets(dag: &Dag, root: Node, factors: &[Node]) -> bool {
    let is_met = |part: &(Node, i32)| part.1 < 0 && factors.contains(&part.0);
    let mut meets = false;
    dag.reached(&[root], &mut |node, ahead| match dag.kind(node) {
        Kind::Sum(_, terms) => ahead.extend(terms.iter().map(|(_, n)| n)),
        Kind::Product(_, parts) => match parts.as_slice() {
            [(inner, 1)] => ahead.add(*inner),
            parts => meets |= parts.iter().any(is_met),
        },
        _ => {}
    });
    meets
}
