//! Sets that no orbit crosses: zeros of constants of the motion, and points where H is infinite.
//!
//! Input: a statement and what is known so far. Output: more of it, in [`Given`]. Invariant: what is
//! said to be constant is proven to be so by the rules of [`Claim`]; what is said not to be 0 is
//! an infinity of a conserved H for all parameters.

use super::Claim;
use super::instances;
use super::walls::{self, At};
use crate::bracket::certificate::{Place, Reason};
use crate::bracket::derivative;
use crate::dag::{Dependence, Kind, Map, Node, Partial, StandIn};
use crate::facts::{Facts, Given, STEP};
use crate::model::Model;
use crate::normal_form::{self, Scope};
use crate::op::SingularSet;
use crate::rational::Rational;

/// The most expressions that are looked at.
const MAX_EXPRESSIONS: usize = 64;

/// The findings of [`learn`].
#[derive(Default)]
pub(super) struct Learnt {
    /// The places, and why no orbit crosses them.
    pub(super) places: Vec<Place>,
    /// True if there were more expressions than are looked at.
    is_cut: bool,
}

impl Learnt {
    /// The limit, as the end of a sentence.
    pub(super) fn limit(&self) -> Option<String> {
        self.is_cut.then(|| {
            format!("; of the expressions that may be constant along orbits only {MAX_EXPRESSIONS} are tried")
        })
    }
}

/// Adds what is known of the places where a statement may jump.
pub(super) fn learn(model: &mut Model, claim: &Claim, given: &mut Given) -> Learnt {
    let mut tried: Map<Node, ()> = Map::default();
    let below = model.dag.reachable(&[claim.expression]);
    let mut learnt = Learnt::default();
    // Each expression is tried once, up to the limit.
    let mut is_new = |node: Node, is_cut: &mut bool| {
        if tried.contains_key(&node) {
            return false;
        }
        *is_cut |= tried.len() == MAX_EXPRESSIONS;
        tried.len() < MAX_EXPRESSIONS && tried.insert(node, ()).is_none()
    };
    if below.binary_search(&claim.h).is_ok() && is_constant(model, claim, claim.h, given) {
        let energy = Place::named(model, "H", claim.h, Reason::Constant);
        learnt.places.push(energy);
        given.constant.insert(claim.h, ());
    }
    // Functions of a constant are constant too, which reveals further sets.
    loop {
        let mut facts = Facts::of(&model.dag, &[claim.expression], given);
        // On the level of a constant, orbits may come to every point.
        if !given.constant.is_empty() {
            let everywhere = Facts::everywhere(&model.dag, &[claim.expression], given);
            facts.loci.extend(everywhere.loci);
        }
        let mut found = false;
        for locus in &facts.loci {
            for node in [locus.x, locus.y] {
                if facts.get(node).is_still || !is_new(node, &mut learnt.is_cut) {
                    continue;
                }
                let reason = if is_constant(model, claim, node, given) {
                    given.constant.insert(node, ());
                    Reason::Constant
                } else if locus.at == SingularSet::Zero && is_wall(model, claim, node, given) {
                    given.nonzero.insert(node, ());
                    Reason::HIsInfinite
                } else {
                    continue;
                };
                found = true;
                learnt.places.push(Place::of(model, node, reason));
            }
        }
        for condition in model.dag.reachable(&[claim.expression]) {
            if let Kind::Compare(_, a, b) = *model.dag.kind(condition) {
                let is_still = facts.get(condition).is_still;
                if is_still || !is_new(condition, &mut learnt.is_cut) {
                    continue;
                }
                // An orbit stays on one side of a = b, unless a − b changes its sign at a pole.
                let apart = model.dag.sub(a, b);
                let reason = if is_constant(model, claim, apart, given) {
                    Reason::Constant
                } else if is_wall(model, claim, apart, given) && is_finite(model, apart, given) {
                    Reason::HIsInfinite
                } else {
                    continue;
                };
                given.constant.insert(condition, ());
                found = true;
                learnt.places.push(Place::of(model, apart, reason));
            }
        }
        if !found {
            return learnt;
        }
    }
}

/// An expression with a constant in the place of H, if it reads H: {H, H} = 0 without expansion. Assumes
/// an H that does not depend on time, and no force.
pub(in crate::proofs::bracket) fn without_energy(
    model: &mut Model,
    expression: Node,
    h: Node,
) -> Option<Node> {
    let has_time = model.dag.dependence(h).on(Dependence::TIME);
    if !model.force.is_empty() || has_time {
        return None;
    }
    let dag = &mut model.dag;
    let energy = dag.stand_in(StandIn::Energy);
    let mut rest = dag.substitute(expression, |_, node| (node == h).then_some(energy));
    // A sum that H is added to has the terms of H among its own.
    if let (Kind::Sum(_, terms), Kind::Sum(_, of_h)) = (dag.kind(rest), dag.kind(h))
        && let Some((k, _)) = terms.iter().find(|(_, term)| *term == of_h[0].1)
        && let Some(by) = of_h[0].0.recip()
    {
        let count = terms.len();
        let others = dag.linear(
            &Rational::ZERO,
            &[(Rational::ONE, rest), (k.mul(&by).neg(), h)],
        );
        if !matches!(dag.kind(others), Kind::Sum(_, left) if left.len() >= count) {
            rest = others;
        }
    }
    (rest != expression).then_some(rest)
}

/// Returns true if an expression is constant along orbits. In a loop, that of each iteration: an arbitrary
/// function of it is summed.
fn is_constant(model: &mut Model, claim: &Claim, node: Node, given: &Given) -> bool {
    let this = Claim {
        expression: node,
        ..*claim
    };
    if this.passes(model, given).is_none() {
        return false;
    }
    if node == claim.h {
        return claim.is_still;
    }
    let dag = &mut model.dag;
    let mut sum = dag.external(STEP, Partial::Value, &[node]);
    for domain in dag.path(dag.home(node)).into_iter().rev() {
        sum = dag.reduce(domain, sum);
    }
    let rate = derivative(model, sum, claim.h);
    rate.is_some_and(|rate| normal_form::vanishes(&mut model.dag, rate, Scope::Densely))
}

/// Returns true if an expression is finite and continuous at every point that orbits come to.
fn is_finite(model: &Model, node: Node, given: &Given) -> bool {
    let facts = Facts::everywhere(&model.dag, &[node], given);
    facts.get(node).is_continuous
}

/// Returns true if no orbit reaches the place where a node is 0: H is conserved, and infinite there for all
/// parameters and sizes. Assumes that H has no step elsewhere, at which it would not be conserved.
fn is_wall(model: &mut Model, claim: &Claim, node: Node, given: &Given) -> bool {
    let facts = Facts::of(&model.dag, &[claim.h], &Given::default());
    claim.is_still
        && facts.get(claim.h).is_projective
        && (walls::is_infinite(&mut model.dag, claim.h, node, given, At::All)
            || instances::is_infinite(model, claim.h, node, given))
}
