//! Poisson brackets and the proof or refutation of invariants.
//!
//! Input: a model and an expression. Output: [`bracket`] as an expression, [`Verdict`]. Invariant:
//! proven means for all sizes and parameters, at all points where the statement and H are defined (on
//! the shell, if one is given), and across what may jump or has a pole, by rules alone; disproven
//! comes with sizes and a point where the time derivative along the flow is not zero.

mod branches;
mod certificate;
mod cross;
mod lagrange;
mod pair;
mod shell;

pub(crate) use branches::agree;
pub use certificate::{Certificate, Place, Reason, Rule};
pub use pair::bracket;

use crate::dag::{Dependence, Kind, Node};
use crate::diff;
use crate::legendre::Legendre;
use crate::list::IntoList;
use crate::loops::{SamplePoint, unroll_nodes};
use crate::model::Model;
use crate::normal_form::{self, Algebra, Answer, BUDGET, Effort, Scope, named, trials, witness};
use crate::print;
use crate::rational::Rational;
use crate::structure::expand_within;
use cross::orbits;

/// The verdict on a claimed invariant.
#[derive(Clone, PartialEq, Debug)]
pub enum Verdict {
    /// It is conserved, and how this is shown.
    Proven(Certificate),
    /// It is not.
    Disproven {
        /// Its time derivative along the flow, {I, H} + ∂I/∂t, as text.
        residual: String,
        /// Sizes, parameters, coordinates and momenta with values at which the residual is not 0.
        point: SamplePoint,
        /// The residual there.
        value: f64,
    },
    /// Neither was shown.
    Undecided {
        /// Its time derivative along the flow as text.
        residual: String,
        /// The rule or the limit that stopped the proof: a clause.
        why: String,
    },
    /// It is conserved as long as nothing jumps.
    Jumps {
        /// The part of the statement, of H or of the force that may jump, as text.
        part: String,
        /// The possible behaviour, its place, and the rule that does not decide it: a predicate of the part.
        why: String,
    },
    /// The statement is about a shell that orbits leave.
    NoShell {
        /// Why they do: a clause.
        why: String,
    },
}

impl Verdict {
    /// The derivative vanishes identically, of which [`cross`] makes a proof.
    fn identity() -> Verdict {
        Verdict::Proven(Certificate::default())
    }

    /// Returns true if it is conserved.
    #[must_use]
    pub fn is_proven(&self) -> bool {
        matches!(self, Verdict::Proven(_))
    }
}

/// Judges if an expression is conserved along the flow of the model's H: {I, H} + ∂I/∂t = 0. With a
/// `shell` the statement is about points with H = shell only, which takes a constant shell and a
/// conserved H.
#[must_use]
pub fn is_invariant(model: &Model, expression: Node, shell: Option<Node>) -> Verdict {
    let model = &*model.with_rooms(&[model.h(), expression]);
    if let Some(refused) = shell.and_then(|shell| left(model, shell)) {
        return refused;
    }
    let (verdict, is_on_shell) = judge(model, expression, shell);
    let verdict = crossed(model, expression, verdict, is_on_shell);
    let is_open = matches!(verdict, Verdict::Undecided { .. } | Verdict::Jumps { .. });
    match is_open && shell.is_none() && is_energy(model, expression) {
        true => crossed(model, model.h(), Verdict::identity(), false),
        false => verdict,
    }
}

/// Returns true if an expression is proven to be H in another form, wherever both have values, and H is conserved along
/// orbits unless it jumps: it does not depend on time, and no force acts.
fn is_energy(model: &Model, expression: Node) -> bool {
    let mut model = model.clone();
    let h = model.h();
    let is_still = model.force.is_empty() && !model.dag.dependence(h).on(Dependence::TIME);
    let difference = model.dag.sub(expression, h);
    is_still && normal_form::vanishes(&mut model.dag, difference, Scope::Everywhere)
}

/// Why orbits may leave a shell, if they may.
fn left(model: &Model, shell: Node) -> Option<Verdict> {
    let no_shell = |why: &str| {
        let why = why.to_owned();
        Some(Verdict::NoShell { why })
    };
    if model.dag.dependence(shell).on(Dependence::MOVING) {
        return no_shell("its energy is no constant");
    }
    let h = model.h();
    if model.force.is_empty() && !model.dag.dependence(h).on(Dependence::TIME) {
        return None;
    }
    match judge(model, h, None).0 {
        Verdict::Proven(_) => None,
        Verdict::Disproven { .. } => no_shell("H is not conserved"),
        undecided => Some(undecided),
    }
}

/// Decides an invariant of a model that a Lagrangian became. `in_velocities` is the expression as it was
/// before velocities became functions of momenta: proofs
/// in them need no inverse of the mass matrix.
#[must_use]
pub fn is_invariant_of_lagrangian(
    model: &Model,
    expression: Node,
    legendre: &Legendre,
    in_velocities: Node,
) -> Verdict {
    let model = &*model.with_rooms(&[model.h(), expression, in_velocities]);
    let has_velocities = model.dag.dependence(in_velocities).on(Dependence::VELOCITY);
    let is_free = model.force.is_empty();
    let is_of_velocities = is_free && has_velocities;
    let verdict = if is_of_velocities && lagrange::vanishes(model, legendre, in_velocities) {
        Verdict::identity()
    } else {
        let mut verdict = judge(model, expression, None).0;
        if let Verdict::Undecided { why, .. } = &mut verdict
            && is_of_velocities
            && let Some(limit) = lagrange::limit(legendre)
        {
            why.push_str(&format!("; {limit}"));
        }
        verdict
    };
    crossed(model, expression, verdict, false)
}

/// The verdict, with what derivatives and points do not see.
fn crossed(model: &Model, expression: Node, verdict: Verdict, is_on_shell: bool) -> Verdict {
    let h = model.h();
    let is_rust = |kind: &Kind| matches!(kind, Kind::External(..));
    let has_rust = model.dag.has(&[h, expression], &is_rust);
    match verdict {
        // A point refutes for the function that was tried, which is not the one in Rust.
        Verdict::Disproven { residual, .. } if has_rust => Verdict::Undecided {
            residual,
            why: "nothing is known of the functions in Rust in it".to_owned(),
        },
        Verdict::Proven(_) => match cross::find(model, expression, h, is_on_shell) {
            Ok(certificate) => Verdict::Proven(certificate),
            Err(found) => Verdict::Jumps {
                part: found.part,
                why: found.why,
            },
        },
        verdict => verdict,
    }
}

/// The verdict for functions in Rust of which nothing is known, and whether it is about the shell
/// only.
fn judge(model: &Model, expression: Node, shell: Option<Node>) -> (Verdict, bool) {
    let mut model = model.clone();
    let h = model.h();
    let difference = shell.map(|e| model.dag.sub(h, e));
    // Past the last number for a loop, loops may be taken for others.
    if !model.dag.has_too_many_loops()
        && let Some(rest) = orbits::without_energy(&mut model, expression, h)
        && (!model.dag.dependence(rest).on(Dependence::MOVING) || {
            let rate = derivative(&mut model, rest, h);
            rate.is_some_and(|rate| normal_form::vanishes(&mut model.dag, rate, Scope::Densely))
        })
    {
        return (Verdict::identity(), false);
    }
    let general = derivative(&mut model, expression, h);
    // A proof for all points, and all sizes, is the common case and the cheapest.
    if let Some(residual) = general
        && normal_form::vanishes(&mut model.dag, residual, Scope::Densely)
    {
        return (Verdict::identity(), false);
    }
    let is_on_shell = shell.is_some();
    let mut text = "the bracket with H".to_owned();
    if let Some(residual) = general {
        match readable(&mut model, residual) {
            Some(residual) => text = residual,
            None => return (Verdict::identity(), false),
        }
    }
    if !model.dag.has_loops(&[h, expression]) && model.sizes.is_empty() {
        let verdict = match general {
            Some(residual) => decide(&mut model, residual, difference, &[h, expression], text),
            None => Verdict::Undecided {
                residual: text,
                why: indices(),
            },
        };
        return (verdict, is_on_shell);
    }
    let mut why = match general {
        Some(residual) => normal_form::answer(&mut model.dag, residual, Scope::Densely).why(),
        None => indices(),
    };
    if !model.force.is_empty() {
        let why = "sizes cannot be tried: a force acts in a loop".to_owned();
        let residual = text;
        return (Verdict::Undecided { residual, why }, is_on_shell);
    }
    // Small sizes may refute; literal ones may also prove.
    let mut roots = vec![h, expression];
    roots.extend(difference);
    for sizes in trials(&model, &roots) {
        let Ok((mut small, images)) = unroll_nodes(&model, &sizes, &roots) else {
            continue;
        };
        let Some(residual) = derivative(&mut small, images[1], images[0]) else {
            continue;
        };
        if general.is_none()
            && let Some(residual) = readable(&mut small, residual)
        {
            text = residual;
        }
        let shell = images.get(2).copied();
        match decide(&mut small, residual, shell, &images[..2], text.clone()) {
            Verdict::Disproven {
                residual,
                mut point,
                value,
            } => {
                point.splice(0..0, named(&model, &sizes));
                let verdict = Verdict::Disproven {
                    residual,
                    point,
                    value,
                };
                return (verdict, is_on_shell);
            }
            Verdict::Proven(_) if model.sizes.is_empty() => {
                return (Verdict::identity(), is_on_shell);
            }
            Verdict::Undecided { why: last, .. } if model.sizes.is_empty() => why = last,
            _ => {}
        }
    }
    let residual = text;
    (Verdict::Undecided { residual, why }, is_on_shell)
}

fn indices() -> String {
    "the indices of an array cannot be solved for the variables of loops".to_owned()
}

/// {I, H} + f·∂I/∂p + ∂I/∂t with the force f
fn derivative(model: &mut Model, expression: Node, h: Node) -> Option<Node> {
    let flow = pair::along_flow(model, expression, h)?;
    let explicit = diff::gradient(&mut model.dag, expression, Dependence::TIME);
    let parts: Vec<Node> = std::iter::once(flow)
        .chain(explicit.into_iter().map(|(_, adjoint)| adjoint))
        .into_list();
    let sum = model.dag.add(&parts);
    (!model.dag.has_too_many_loops()).then_some(sum)
}

/// The verdict on a residual without loops, of what has values only where `others` have.
fn decide(
    model: &mut Model,
    residual: Node,
    difference: Option<Node>,
    others: &[Node],
    text: String,
) -> Verdict {
    if model.dag.is_zero(residual) {
        return Verdict::identity();
    }
    let found = match difference {
        None => witness(model, residual, Effort::Search, others),
        Some(difference) => shell::witness(model, residual, difference, others),
    };
    if let Some((point, value)) = found {
        return Verdict::Disproven {
            residual: text,
            point,
            value,
        };
    }
    let answer = match difference {
        None => normal_form::answer(&mut model.dag, residual, Scope::Densely),
        Some(difference) => {
            let mut algebra = Algebra::new(BUDGET, Scope::Everywhere);
            match shell::vanishes(&mut algebra, &model.dag, residual, difference) {
                Ok(true) => Answer::Zero,
                Ok(false) => Answer::Other(algebra.left_out),
                Err(undecided) => Answer::Limit(undecided),
            }
        }
    };
    match answer {
        Answer::Zero => Verdict::identity(),
        _ => Verdict::Undecided {
            residual: text,
            why: answer.why(),
        },
    }
}

/// The text of a residual: as it came, or multiplied out, whichever is shorter. `None` where nothing is
/// left of it.
fn readable(model: &mut Model, residual: Node) -> Option<String> {
    let plain = print::text(model, residual);
    // More terms make a longer text.
    let most = plain.len() / 2 + 1;
    let Some(terms) = expand_within(&mut model.dag, residual, most) else {
        return Some(plain);
    };
    let mut operands = Vec::with_capacity(terms.len());
    for term in &terms {
        operands.push((Rational::ONE, term.node(&mut model.dag)));
    }
    let expanded = model.dag.linear(&Rational::ZERO, &operands);
    if model.dag.is_zero(expanded) {
        return None;
    }
    let expanded = print::text(model, expanded);
    Some(if expanded.len() <= plain.len() {
        expanded
    } else {
        plain
    })
}
