//! The step from "its derivative vanishes wherever everything is smooth" to "it is constant along
//! every orbit".
//!
//! Input: a model, an expression whose derivative along the flow of H vanishes. Output: the certificate of
//! the rule of [`Claim::passes`] that applies, or the part that stands in the way, and why.
//! Invariant: no rule here looks at points, and each states what it assumes of ranges, poles and functions:
//! - a range may be empty, for some size or in some iteration of the loops around it;
//! - an orbit crosses a pole of a part of H, or of the statement, where H itself stays finite, as it crosses
//!   q = 0 under p²/2 + 1/(1 − 1/q)², and on any set where infinities of H cancel or are multiplied by 0;
//! - functions in Rust are analytic, which the certificate says.

mod instances;
pub(super) mod orbits;
mod walls;

use super::certificate::{Certificate, Place, Reason, Rule};
use super::{branches, derivative};
use crate::dag::{Dag, Dependence, Kind, Node};
use crate::facts::{Facts, Given, Locus, Regular, comparisons};
use crate::list::IntoList;
use crate::model::Model;
use crate::normal_form::{self, Scope};
use crate::op::{Break, Op, SingularSet};
use crate::print;
use crate::rational::Rational;
use walls::At;

const BOTH_SIDES: &str = "may jump, which no derivative shows; no rule says that both sides agree";

/// An obstacle to a proof.
pub(super) struct Obstacle {
    /// The part that stands in the way, as text.
    pub(super) part: String,
    /// The possible behaviour, and the rule that is missing: a predicate of the part.
    pub(super) why: String,
}

/// The certificate of an expression whose derivative along the flow of `h` vanishes, everywhere or,
/// with `is_on_shell`, on one shell of H only; or the first obstacle.
pub(super) fn find(
    model: &Model,
    expression: Node,
    h: Node,
    is_on_shell: bool,
) -> Result<Certificate, Obstacle> {
    let mut model = model.clone();
    let claim = Claim::new(&model, expression, h, is_on_shell);
    let roots = claim.roots(&model);
    let mut given = branches::known(&mut model.dag, &roots);
    if let Some(rule) = claim.passes(&mut model, &given) {
        return Ok(claim.certificate(&mut model, vec![rule], &given, &[]));
    }
    if let Some(found) = claim.passes_tidily(&mut model) {
        return Ok(found);
    }
    if !is_on_shell && let Some(found) = claim.passes_without_steps(&mut model) {
        return Ok(found);
    }
    let known = given.clone();
    let learnt = match is_on_shell {
        true => orbits::Learnt::default(),
        false => orbits::learn(&mut model, &claim, &mut given),
    };
    if !learnt.places.is_empty() {
        // A condition on a constant of the motion counts at the one value where it switches: orbits
        // stay there.
        let rest = orbits::without_energy(&mut model, expression, h).unwrap_or(expression);
        let rate = derivative(&mut model, rest, h);
        let vanishes = |rate| normal_form::vanishes(&mut model.dag, rate, Scope::Everywhere);
        let is_constant = rate.is_some_and(vanishes);
        if let Some(rule) = claim.passes(&mut model, &given) {
            if is_constant {
                return Ok(claim.certificate(&mut model, vec![rule], &given, &learnt.places));
            }
            return Err(Obstacle {
                part: print::text(&model, expression),
                why: "may change where a condition on constants of the motion switches".to_owned(),
            });
        }
    }
    let mut obstacle = claim.obstacle(&mut model, &known);
    if let Some(limit) = learnt.limit() {
        obstacle.why.push_str(&limit);
    }
    Err(obstacle)
}

/// A statement to prove: an expression is constant along the orbits of H under the model's force.
#[derive(Clone, Copy)]
pub(super) struct Claim {
    pub(super) expression: Node,
    pub(super) h: Node,
    /// True if its derivative is known to vanish on one shell of H only.
    pub(super) is_on_shell: bool,
    /// True if H is constant along orbits: it does not depend on time, and there is no force.
    pub(super) is_still: bool,
}

/// Returns true if the flow of H is continuous: H is continuous into the closed line term by term, so that it
/// is infinite or finite at each point, and analytic wherever it is finite, so that its velocity is
/// Lipschitz there. Each part with a kink or a steep root that vanishes is one that makes H infinite, or only
/// a divisor, or in a logarithm, of terms that are infinite where it vanishes. Assumes that what has a jump is
/// nowhere in H.
fn has_continuous_flow(dag: &mut Dag, h: Node, everywhere: &Facts, given: &Given) -> bool {
    if !is_projective_by_terms(dag, h, everywhere) {
        return false;
    }
    let nodes = dag.reachable(&[h]);
    let is_rough = |dag: &Dag, node: Node| match dag.kind(node) {
        Kind::Call(op, _) => {
            let has_root = matches!(op, Op::Sqrt | Op::Cbrt | Op::Hypot | Op::Pow);
            has_root || op.row().regularity.breaks != Break::Nowhere
        }
        Kind::Select(..) => true,
        _ => false,
    };
    let is_vanishing_alone = |dag: &Dag, node: Node| {
        matches!(
            dag.kind(node),
            Kind::Call(Op::Sqrt | Op::Cbrt | Op::Hypot | Op::Abs, _)
        )
    };
    let is_divided_by = |dag: &Dag, user: Node, node: Node| match dag.kind(user) {
        Kind::Product(_, factors) => factors.iter().all(|(base, n)| *base != node || *n < 0),
        Kind::Call(Op::Ln, _) => true,
        _ => false,
    };
    let users = |dag: &Dag, node: Node| -> Vec<Node> {
        let reads = |user: &&Node| {
            let mut is_read = false;
            dag.for_children(**user, |child| is_read |= child == node);
            is_read
        };
        nodes.iter().filter(reads).copied().into_list()
    };
    let is_only_divisor = |dag: &Dag, node: Node| {
        let mut users = users(dag, node).into_iter();
        node != h && users.all(|user| is_divided_by(dag, user, node))
    };
    let is_steep = |dag: &Dag, node: Node| {
        let mut users = users(dag, node).into_iter();
        users.all(|user| is_coordinate_over(dag, user, everywhere))
    };
    let rough: Vec<Node> = nodes
        .iter()
        .copied()
        .filter(|node| !everywhere.get(*node).is_analytic && is_rough(dag, *node))
        .into_list();
    rough.into_iter().all(|node| {
        is_vanishing_alone(dag, node)
            && (is_only_divisor(dag, node)
                && (is_steep(dag, node) || walls::is_infinite(dag, h, node, given, At::Most))
                || walls::is_infinite(dag, h, node, given, At::All))
    })
}

/// Returns true if each term of H is continuous into the closed line at every point, so that no motion goes on
/// through the zeros of a factor of an infinity, or is a coordinate over functions. Infinities of several terms
/// may cancel where they meet.
fn is_projective_by_terms(dag: &Dag, h: Node, everywhere: &Facts) -> bool {
    if everywhere.get(h).is_projective || is_coordinate_over(dag, h, everywhere) {
        return true;
    }
    match dag.kind(h) {
        Kind::Sum(_, terms) => {
            let mut terms = terms.iter();
            terms.all(|(_, term)| is_projective_by_terms(dag, *term, everywhere))
        }
        Kind::Reduce(_, body) => is_projective_by_terms(dag, *body, everywhere),
        Kind::Product(_, factors) => {
            let is_moving = |(factor, _): &&(Node, i32)| !everywhere.get(*factor).is_still;
            let mut moving = factors.iter().filter(is_moving);
            match (moving.next(), moving.next()) {
                (Some((factor, 1)), None) => is_projective_by_terms(dag, *factor, everywhere),
                _ => false,
            }
        }
        _ => false,
    }
}

/// Returns true if a term is a coordinate x over Lipschitz functions D. Where both are 0 on an orbit with a finite
/// velocity, the force ∂H/∂x grows as 1/D, and |D| at most as the time to or from there, so that the momentum
/// is infinite.
fn is_coordinate_over(dag: &Dag, term: Node, everywhere: &Facts) -> bool {
    let Kind::Product(_, factors) = dag.kind(term) else {
        return false;
    };
    let is_leaf = |node: Node| matches!(dag.kind(node), Kind::Element(..));
    let mut above = 0;
    let are_fine = factors.iter().all(|(factor, n)| {
        let regular = everywhere.get(*factor);
        let is_above = !regular.is_still && *n > 0;
        above += usize::from(is_above);
        regular.is_still
            || is_above && *n == 1 && is_leaf(*factor)
            || *n < 0 && regular.is_lipschitz
    });
    are_fine && above == 1
}

impl Claim {
    pub(super) fn new(model: &Model, expression: Node, h: Node, is_on_shell: bool) -> Claim {
        let has_time = model.dag.dependence(h).on(Dependence::TIME);
        Claim {
            expression,
            h,
            is_on_shell,
            is_still: model.force.is_empty() && !has_time,
        }
    }

    /// The expressions the rules read: the statement, H, the force.
    fn roots(&self, model: &Model) -> Vec<Node> {
        let force = model.force.iter().map(|entry| entry.value);
        [self.expression, self.h]
            .into_iter()
            .chain(force)
            .into_list()
    }

    /// The rule that applies. In each the derivative vanishes at least at points near every point,
    /// of phase space or of the shell.
    pub(super) fn passes(&self, model: &mut Model, given: &Given) -> Option<Rule> {
        let roots = self.roots(model);
        let is_free = model.force.is_empty();
        let dag = &mut model.dag;
        let everywhere = Facts::everywhere(dag, &roots, given);
        if self.is_on_shell {
            let are_analytic = roots.iter().all(|root| everywhere.get(*root).is_analytic);
            let is_enough = self.passes_by_continuation(&everywhere) && (is_free || are_analytic);
            return is_enough.then_some(Rule::Continuation);
        }
        if is_free && self.passes_by_continuation(&everywhere) {
            return Some(Rule::Continuation);
        }
        let most = Facts::of(dag, &roots, given);
        // H may have no step: a step pushes orbits, which no derivative shows.
        if !most.get(self.h).is_projective {
            return None;
        }
        // The derivative of a function with continuous first derivatives is linear in the velocity of
        // the orbit. It vanishes for all limits of velocities at a kink or jump of the force, so for
        // their convex combinations too, along which orbits slide or stop there (Filippov 1988,
        // Differential Equations with Discontinuous Righthand Sides, §4). Assumes nothing of the flow.
        if everywhere.get(self.expression).is_analytic {
            return Some(Rule::Smoothness);
        }
        // Where the velocity is not Lipschitz, as at the equilibrium of p²/2 − |q|, orbits branch and come to
        // rest: the statement, up to H, is to hold at every point. A force may stop an orbit anywhere.
        let is_continuous = self.keeps_values(&most) && most.get(self.expression).is_projective;
        if is_free && is_continuous {
            let mut beside = given.clone();
            if self.is_still {
                beside.constant.insert(self.h, ());
            }
            let beside_h = Facts::everywhere(dag, &roots, &beside);
            if beside_h.get(self.expression).is_projective {
                return Some(Rule::Continuity);
            }
        }
        // Sets of two dimensions less do not count under a flow that is continuous with its inverse. They do if
        // anything was learnt of single orbits: on a level of a constant of the motion they may have
        // one dimension less.
        let is_learnt = !given.constant.is_empty() || !given.nonzero.is_empty();
        let force = roots[2..].iter().map(|f| everywhere.get(*f));
        let is_continuous_flow = match force.reduce(Regular::and) {
            None => has_continuous_flow(dag, self.h, &everywhere, given),
            Some(force) => force.is_lipschitz && everywhere.get(self.h).is_analytic,
        };
        if is_learnt || !is_continuous_flow {
            return None;
        }
        if is_free && self.passes_by_continuation(&most) {
            return Some(Rule::Continuation);
        }
        is_continuous.then_some(Rule::Continuity)
    }

    /// Returns true if H keeps orbits in one piece: it is finite, or conserved and continuous into the closed line.
    fn keeps_values(&self, facts: &Facts) -> bool {
        let h = facts.get(self.h);
        h.is_continuous || h.is_projective && self.is_still
    }

    /// The certificate of a proof by a rule: the poles and thresholds at which both sides agree, and what was
    /// learnt of orbits.
    fn certificate(
        &self,
        model: &mut Model,
        rules: Vec<Rule>,
        given: &Given,
        learnt: &[Place],
    ) -> Certificate {
        let roots = self.roots(model);
        let facts = Facts::of(&model.dag, &roots, given);
        let mut places: Vec<Place> = learnt.to_vec();
        let mut zeros: Vec<Node> = Vec::new();
        for locus in &facts.loci {
            zeros.extend(zero(&mut model.dag, *locus));
        }
        let meeting: Vec<Node> = given.meeting.keys().copied().into_list();
        for node in meeting {
            if let Kind::Select(condition, ..) = *model.dag.kind(node)
                && !facts.get(condition).is_still
            {
                for (a, b) in comparisons(&model.dag, condition) {
                    zeros.push(model.dag.sub(a, b));
                }
            }
        }
        for zero in zeros {
            // The functions that stand for steps have no names.
            let count = model.externals.len();
            let is_unnamed =
                |kind: &Kind| matches!(kind, Kind::External(at, ..) if usize::from(*at) >= count);
            let is_named = !model.dag.has(&[zero], &is_unnamed);
            if is_named && model.dag.dependence(zero).on(Dependence::MOVING) {
                places.push(Place::of(model, zero, Reason::BothSidesAgree));
            }
        }
        Certificate::new(model, rules, places, &roots)
    }

    /// Quotients of analytic functions. With H = N/D, the orbits with H = e are, up to their
    /// parametrisation, those of N − eD with N − eD = 0, which are analytic curves (of a
    /// time-dependent H, those of H + p_t in the extended phase space). Along these the statement is a
    /// quotient of analytic functions of one variable, so that it is constant if it is on an
    /// interval. Assumes that there is no force, or that all three are analytic. On a shell, assumes it
    /// of every point.
    fn passes_by_continuation(&self, facts: &Facts) -> bool {
        facts.get(self.expression).is_meromorphic && facts.get(self.h).is_meromorphic
    }

    /// Returns true if a rule applies to the normal form of the statement, which has its values wherever the
    /// statement has any.
    fn passes_tidily(&self, model: &mut Model) -> Option<Certificate> {
        let tidy = normal_form::tidy(&mut model.dag, self.expression)?;
        let tidy = Claim {
            expression: tidy,
            ..*self
        };
        let roots = tidy.roots(model);
        let given = branches::known(&mut model.dag, &roots);
        let rule = tidy.passes(model, &given)?;
        Some(tidy.certificate(model, vec![Rule::NormalForm, rule], &given, &[]))
    }

    /// The certificate of a rule that applies to every H with smooth functions in the place of its steps; `None` if H has
    /// no steps or no rule applies.
    ///
    /// Orbits of H with steps are limits of orbits of such H. Assumes a statement without steps.
    fn passes_without_steps(&self, model: &mut Model) -> Option<Certificate> {
        let given = branches::known(&mut model.dag, &[self.h]);
        let (h, steps) = branches::smoothed(model, self.h, &given)?;
        let smooth = Claim { h, ..*self };
        let roots = smooth.roots(model);
        let given = branches::known(&mut model.dag, &roots);
        let rate = derivative(model, smooth.expression, smooth.h)?;
        if !normal_form::vanishes(&mut model.dag, rate, Scope::Densely) {
            return None;
        }
        let rule = smooth.passes(model, &given)?;
        let places: Vec<Place> = steps
            .into_iter()
            .map(|step| Place::of(model, step, Reason::StepOfH))
            .into_list();
        Some(smooth.certificate(model, vec![Rule::SmoothedSteps, rule], &given, &places))
    }

    /// The first part that no rule lets pass, of the first term that does not pass by itself.
    fn obstacle(&self, model: &mut Model, given: &Given) -> Obstacle {
        let mut roots = self.roots(model);
        if let Kind::Sum(_, terms) = model.dag.kind(self.expression).clone() {
            let mut stays = |(_, term): &(Rational, Node)| {
                let alone = Claim {
                    expression: *term,
                    ..*self
                };
                alone.passes(model, given).is_none() && alone.passes_tidily(model).is_none()
            };
            if let Some((_, term)) = terms.iter().find(|term| stays(term)) {
                roots[0] = *term;
            }
        }
        let most = Facts::of(&model.dag, &roots, given);
        let everywhere = Facts::everywhere(&model.dag, &roots, given);
        let is_projective = |regular: Regular| regular.is_projective;
        let is_gentle = |regular: Regular| regular.is_lipschitz;
        let is_quotient = |regular: Regular| regular.is_meromorphic;
        let (part, why) = if self.is_on_shell {
            let part = culprit(&model.dag, &everywhere, &roots, is_quotient);
            let why = "is no quotient of analytic functions, of which proofs on a shell are made";
            (part, why.to_owned())
        } else if let Some(part) = culprit(&model.dag, &most, &roots[..2], is_projective) {
            let mut loci = most.loci.iter();
            let place = loci.find_map(|locus| place(model, *locus, part));
            (Some(part), place.unwrap_or_else(|| BOTH_SIDES.to_owned()))
        } else if let Some(part) = culprit(&model.dag, &everywhere, &roots[2..], is_gentle) {
            let why = "is not Lipschitz everywhere: under such a force motion may stop or branch, which no \
                       derivative shows";
            (Some(part), why.to_owned())
        } else if model.force.is_empty()
            && let Some(part) = culprit(&model.dag, &everywhere, &roots[..2], is_projective)
        {
            let why = "may jump, which no derivative shows: where H has a kink or a steep root, motion may \
                       stop or branch";
            (Some(part), why.to_owned())
        } else {
            let part = culprit(&model.dag, &most, &roots[1..2], |regular| {
                regular.is_continuous
            });
            let why =
                "may be infinite, and as H changes in time, nothing keeps orbits away from there";
            (part, why.to_owned())
        };
        let part = part.unwrap_or(self.expression);
        Obstacle {
            part: print::text(model, part),
            why,
        }
    }
}

/// The first node without a property that all below it have.
fn culprit(
    dag: &Dag,
    facts: &Facts,
    roots: &[Node],
    is_fine: impl Fn(Regular) -> bool,
) -> Option<Node> {
    roots.iter().find_map(|root| {
        let nodes = dag.reachable(&[*root]);
        nodes.into_iter().find(|node| {
            let is_condition = matches!(
                dag.kind(*node),
                Kind::Compare(..) | Kind::And(..) | Kind::Or(..) | Kind::Not(_)
            );
            !is_condition && !is_fine(facts.get(*node))
        })
    })
}

/// The place of a locus that a part reads, as a clause.
fn place(model: &mut Model, locus: Locus, part: Node) -> Option<String> {
    let dag = &mut model.dag;
    let below = dag.reachable(&[part]);
    let is_below = |node: Node| below.binary_search(&node).is_ok();
    if !(is_below(locus.x) && is_below(locus.y)) {
        return None;
    }
    if locus.at == SingularSet::Cut {
        let why = "may jump, which no derivative shows; the angle of a point does where the point crosses the \
             negative half of an axis";
        return Some(why.to_owned());
    }
    let at = match zero(dag, locus) {
        Some(zero) => format!("`{}` is 0", print::text(model, zero)),
        None => {
            let (x, y) = (print::text(model, locus.x), print::text(model, locus.y));
            match locus.at {
                SingularSet::Whole => format!("`{x}` is whole"),
                SingularSet::HalfWhole => format!("`{x} - 1/2` is whole"),
                SingularSet::Multiple => format!("`{x}` is a multiple of `{y}`"),
                SingularSet::HalfMultiple => {
                    format!("`{x}` is an odd multiple of half of `{y}`")
                }
                _ => return None,
            }
        }
    };
    Some(format!("{BOTH_SIDES} where {at}"))
}

/// The expression that is 0 at a locus; of a cut, on the whole axis. Of other sets none.
fn zero(dag: &mut Dag, locus: Locus) -> Option<Node> {
    let one = dag.integer(1);
    Some(match locus.at {
        SingularSet::Zero | SingularSet::Cut => locus.x,
        SingularSet::One => dag.sub(locus.x, one),
        SingularSet::MinusOne => dag.add(&[locus.x, one]),
        SingularSet::Equal if dag.is_zero(locus.x) => locus.y,
        SingularSet::Equal => dag.sub(locus.x, locus.y),
        SingularSet::Cosine => dag.call(Op::Cos, &[locus.x]),
        SingularSet::PlusMinusOne => {
            let square = dag.powi(locus.x, 2);
            dag.sub(square, one)
        }
        SingularSet::Origin => return None,
        SingularSet::Whole
        | SingularSet::HalfWhole
        | SingularSet::Multiple
        | SingularSet::HalfMultiple => return None,
    })
}
