//! The step from "its derivative vanishes wherever everything is smooth" to "it is constant along
//! every orbit".
//!
//! Input: a model, an expression whose derivative along the flow of H vanishes. Output: nothing where
//! one of the rules of [`Claim::passes`] applies, or the part that stands in the way, and why.
//! Invariant: no rule here looks at points, and each states what it assumes.

pub(super) mod orbits;

use super::{branches, derivative};
use crate::dag::{Dag, Dependence, Kind, Node};
use crate::facts::{Facts, Given, Locus, Regular};
use crate::model::Model;
use crate::normal_form::{self, Scope};
use crate::op::{Break, Op, SingularSet};
use crate::print;
use crate::rational::Rational;

const BOTH_SIDES: &str = "may jump, which no derivative shows; no rule says that both sides agree";

/// An obstacle to a proof.
pub(super) struct Obstacle {
    /// The part that stands in the way, as text.
    pub(super) part: String,
    /// The possible behaviour, and the rule that is missing: a predicate of the part.
    pub(super) why: String,
}

/// The first obstacle for an expression whose derivative along the flow of `h` vanishes, everywhere or,
/// with `is_on_shell`, on one shell of H only.
pub(super) fn find(
    model: &Model,
    expression: Node,
    h: Node,
    is_on_shell: bool,
) -> Option<Obstacle> {
    let mut model = model.clone();
    let claim = Claim::new(&model, expression, h, is_on_shell);
    let roots = claim.roots(&model);
    let mut given = branches::known(&mut model.dag, &roots);
    if claim.passes(&model, &given) {
        return None;
    }
    if claim.passes_tidily(&mut model) || !is_on_shell && claim.passes_without_steps(&mut model) {
        return None;
    }
    let known = given.clone();
    let learnt = match is_on_shell {
        true => orbits::Learnt::default(),
        false => orbits::learn(&mut model, &claim, &mut given),
    };
    if learnt.anything {
        // A condition on a constant of the motion counts at the one value where it switches: orbits
        // stay there.
        let rest = orbits::without_energy(&mut model, expression, h).unwrap_or(expression);
        let rate = derivative(&mut model, rest, h);
        let vanishes = |rate| normal_form::vanishes(&mut model.dag, rate, Scope::Everywhere);
        let is_constant = rate.is_some_and(vanishes);
        if claim.passes(&model, &given) {
            return (!is_constant).then(|| Obstacle {
                part: print::text(&model, expression),
                why: "may change where a condition on constants of the motion switches".to_owned(),
            });
        }
    }
    let mut obstacle = claim.obstacle(&mut model, &known);
    if let Some(limit) = learnt.limit() {
        obstacle.why.push_str(&limit);
    }
    Some(obstacle)
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

/// Returns true if H is analytic wherever it is finite, so that its velocity is Lipschitz there and its flow is
/// continuous: each part with a kink, a jump or a steep root that vanishes is a divisor or in a logarithm,
/// where H is infinite or has no value. Either all its uses are such, or one is a term of H, or a factor of
/// a term, which is read at every point.
fn is_smooth_where_finite(dag: &Dag, h: Node, everywhere: &Facts) -> bool {
    let nodes = dag.reachable(&[h]);
    let terms = terms_and_factors(dag, h);
    let is_rough = |node: Node| match dag.kind(node) {
        Kind::Call(op, _) => {
            let has_root = matches!(op, Op::Sqrt | Op::Cbrt | Op::Hypot | Op::Pow);
            has_root || op.row().regularity.breaks != Break::Nowhere
        }
        Kind::Select(..) => true,
        _ => false,
    };
    let is_vanishing_alone = |node: Node| {
        matches!(
            dag.kind(node),
            Kind::Call(Op::Sqrt | Op::Cbrt | Op::Hypot | Op::Abs, _)
        )
    };
    let is_divided_by = |user: Node, node: Node| match dag.kind(user) {
        Kind::Product(_, factors) => factors.iter().any(|(base, n)| *base == node && *n < 0),
        Kind::Call(Op::Ln, arguments) => arguments.contains(&node),
        _ => false,
    };
    let is_guarded = |node: Node| {
        terms.iter().any(|term| is_divided_by(*term, node))
            || node != h
                && nodes.iter().all(|user| {
                    let mut is_read = false;
                    dag.for_children(*user, |child| is_read |= child == node);
                    !is_read || is_divided_by(*user, node)
                })
    };
    nodes
        .iter()
        .filter(|node| !everywhere.get(**node).is_analytic)
        .all(|node| !is_rough(*node) || is_vanishing_alone(*node) && is_guarded(*node))
}

/// The terms of a sum, its factors with positive powers, and theirs: where one of them is infinite or has
/// no value, so is the sum or it has none.
fn terms_and_factors(dag: &Dag, sum: Node) -> Vec<Node> {
    let mut found = vec![sum];
    let mut next = 0;
    while let Some(node) = found.get(next).copied() {
        next += 1;
        let mut add = |node: Node| {
            if !found.contains(&node) {
                found.push(node);
            }
        };
        match dag.kind(node) {
            Kind::Sum(..) => dag.for_children(node, add),
            Kind::Product(_, factors) => {
                factors
                    .iter()
                    .filter(|(_, n)| *n > 0)
                    .for_each(|(base, _)| add(*base));
            }
            _ => {}
        }
    }
    found
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
        [self.expression, self.h].into_iter().chain(force).collect()
    }

    /// Returns true if a rule applies. In each the derivative vanishes at least at points near every point,
    /// of phase space or of the shell.
    pub(super) fn passes(&self, model: &Model, given: &Given) -> bool {
        let roots = self.roots(model);
        let (dag, is_free) = (&model.dag, model.force.is_empty());
        if !self.is_on_shell && is_free {
            let facts = Facts::of(dag, &roots, given);
            if self.passes_by_continuation(&facts) {
                return true;
            }
            // Sets of two dimensions less do not count under a continuous flow. Where the velocity is not
            // Lipschitz, as at the equilibrium of p²/2 − |q|, orbits branch and come to rest there:
            // the statement, up to H, is to hold at every point.
            let everywhere = Facts::everywhere(dag, &roots, given);
            let is_enough = is_smooth_where_finite(dag, self.h, &everywhere) || {
                let mut given = given.clone();
                if self.is_still {
                    given.constant.insert(self.h, ());
                }
                let beside_h = Facts::everywhere(dag, &roots, &given);
                beside_h.get(self.expression).is_projective
            };
            if is_enough && self.passes_by_continuity(&facts) {
                return true;
            }
        }
        let facts = Facts::everywhere(dag, &roots, given);
        let force = roots[2..].iter().map(|f| facts.get(*f));
        let force = force.reduce(Regular::and);
        if self.is_on_shell {
            return self.passes_by_continuation(&facts)
                && force.is_none_or(|f| {
                    f.is_analytic
                        && self.roots(model)[..2]
                            .iter()
                            .all(|n| facts.get(*n).is_analytic)
                });
        }
        // H may have no step: a step pushes orbits, which no derivative shows.
        let most = Facts::of(dag, &roots, given);
        if !most.get(self.h).is_projective {
            return false;
        }
        // The derivative of a function with continuous first derivatives is linear in the velocity of
        // the orbit. It vanishes for all limits of velocities at a kink or jump of the force, so for
        // their convex combinations too, along which orbits slide or stop there (Filippov 1988,
        // Differential Equations with Discontinuous Righthand Sides, §4). Assumes nothing of the flow.
        if facts.get(self.expression).is_analytic {
            return true;
        }
        // Under a force that is Lipschitz everywhere, the flow is continuous with its inverse.
        force.is_some_and(|force| force.is_lipschitz) && self.passes_by_continuity(&most)
    }

    /// A statement that is continuous, into the line closed by one infinity, under a flow that is
    /// continuous with its inverse: along almost every orbit it is constant between isolated times and
    /// has one limit at each, which is not ∞. Assumes that H is continuous, or that it tends to
    /// infinity where it is not and is conserved, so that no orbit comes there. Not on a shell,
    /// whose neighbours have another energy.
    fn passes_by_continuity(&self, facts: &Facts) -> bool {
        let (expression, h) = (facts.get(self.expression), facts.get(self.h));
        let is_kept = h.is_continuous || h.is_projective && self.is_still;
        is_kept && expression.is_projective
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
    fn passes_tidily(&self, model: &mut Model) -> bool {
        let Some(tidy) = normal_form::tidy(&mut model.dag, self.expression) else {
            return false;
        };
        let tidy = Claim {
            expression: tidy,
            ..*self
        };
        let roots = tidy.roots(model);
        let given = branches::known(&mut model.dag, &roots);
        tidy.passes(model, &given)
    }

    /// Returns true if a rule applies for every H that has smooth functions in the place of its steps: an
    /// orbit of H with steps is a limit of such orbits. Assumes a statement without steps.
    fn passes_without_steps(&self, model: &mut Model) -> bool {
        let given = branches::known(&mut model.dag, &[self.h]);
        let Some(smooth) = branches::smoothed(model, self.h, &given) else {
            return false;
        };
        let smooth = Claim { h: smooth, ..*self };
        let roots = smooth.roots(model);
        let given = branches::known(&mut model.dag, &roots);
        let rate = derivative(model, smooth.expression, smooth.h);
        rate.is_some_and(|rate| normal_form::vanishes(&mut model.dag, rate, Scope::Densely))
            && smooth.passes(model, &given)
    }

    /// The first part that no rule lets pass, of the first term that does not pass by itself.
    fn obstacle(&self, model: &mut Model, given: &Given) -> Obstacle {
        let mut roots = self.roots(model);
        if let Kind::Sum(_, terms) = model.dag.kind(self.expression).clone() {
            let stays = |(_, term): &&(Rational, Node)| {
                let alone = Claim {
                    expression: *term,
                    ..*self
                };
                !alone.passes(model, given) && !alone.passes_tidily(model)
            };
            if let Some((_, term)) = terms.iter().find(stays) {
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
    let one = dag.integer(1);
    let zero = match locus.at {
        SingularSet::Cut => {
            let why = "may jump, which no derivative shows; the angle of a point does where the point crosses the \
                 negative half of an axis";
            return Some(why.to_owned());
        }
        SingularSet::Zero => locus.x,
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
        | SingularSet::HalfMultiple => {
            let (x, y) = (print::text(model, locus.x), print::text(model, locus.y));
            let at = match locus.at {
                SingularSet::Whole => format!("`{x}` is whole"),
                SingularSet::HalfWhole => format!("`{x} - 1/2` is whole"),
                SingularSet::Multiple => format!("`{x}` is a multiple of `{y}`"),
                _ => format!("`{x}` is an odd multiple of half of `{y}`"),
            };
            return Some(format!("{BOTH_SIDES} where {at}"));
        }
    };
    let zero = print::text(model, zero);
    Some(format!("{BOTH_SIDES} where `{zero}` is 0"))
}
