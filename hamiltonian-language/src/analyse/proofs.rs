//! Claims that are proven or refused: invariants, that events can happen, that pieces add up to H.
//!
//! Input: the lowered definition. Output: the certificates of the invariants, and errors with the residual and,
//! where one was found, a point. Invariant: `#[assume]` silences claims that could not be decided, never false
//! ones.

use crate::checked::Checked;
use crate::lower::Lowered;
use crate::report::Report;
use hamiltonian_symbolic::bracket::{
    Certificate, Verdict, is_invariant, is_invariant_of_lagrangian,
};
use hamiltonian_symbolic::dag::{Dependence, Node};
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::loops::SamplePoint;
use hamiltonian_symbolic::model::{Model, ObservableKind};
use hamiltonian_symbolic::transform::check_split;
use proc_macro2::Ident;

/// Of each observable the certificates of its components: none for those that are assumed, and for monitors and
/// events.
pub type Certificates = Vec<Vec<Certificate>>;

/// Proves the claims of the definition on the declared coordinates.
pub fn prove(checked: &Checked, lowered: &mut Lowered, report: &mut Report) -> Certificates {
    let certificates = invariants(checked, lowered, report);
    events(checked, lowered, report);
    if checked.charts.is_empty() {
        split(checked, &mut lowered.model, report);
    }
    certificates
}

fn invariants(checked: &Checked, lowered: &Lowered, report: &mut Report) -> Certificates {
    let mut certificates: Certificates = vec![Vec::new(); checked.observables.len()];
    let mut in_velocities = lowered.in_velocities.iter().copied();
    for (at, observable) in checked.observables.iter().enumerate() {
        let components = &lowered.model.observables[at].components;
        let in_velocities: Vec<Node> = in_velocities.by_ref().take(components.len()).into_list();
        if observable.kind != ObservableKind::Invariant {
            continue;
        }
        let (name, shell) = (&observable.name, lowered.shells[at]);
        let on = if shell.is_some() { " on its shell" } else { "" };
        for (component, value) in components.iter().enumerate() {
            let what = match components.len() {
                1 => format!("`{name}`"),
                _ => format!("component {component} of `{name}`"),
            };
            let verdict = match (&lowered.legendre, in_velocities.get(component), shell) {
                (Some(legendre), Some(in_velocities), None) => {
                    is_invariant_of_lagrangian(&lowered.model, *value, legendre, *in_velocities)
                }
                _ => is_invariant(&lowered.model, *value, shell),
            };
            let (message, help) = match verdict {
                Verdict::Proven(certificate) => {
                    certificates[at].push(certificate);
                    continue;
                }
                Verdict::Disproven {
                    residual,
                    point,
                    value,
                } => (
                    format!(
                        "{what} is not conserved{on}: its time derivative is `{}`, which is {} at {}",
                        shortened(&residual),
                        readable(value),
                        listed(&point)
                    ),
                    "correct it or H, or declare it as `monitor`".to_owned(),
                ),
                Verdict::Undecided { .. } | Verdict::Jumps { .. } if observable.assumed => continue,
                Verdict::NoShell { why } => (
                    format!("{what} is claimed on a shell that orbits leave: {why}"),
                    "write `on H = …` with numbers and parameters, where H is conserved".to_owned(),
                ),
                Verdict::Undecided { residual, why } => (
                    format!(
                        "it is neither proven nor disproven that {what} is conserved{on}: its time derivative is `{}`; {why}",
                        shortened(&residual)
                    ),
                    if_known(name),
                ),
                Verdict::Jumps { part, why } => (
                    format!(
                        "it is not proven that {what} is conserved{on}: `{}` {why}",
                        shortened(&part)
                    ),
                    if_known(name),
                ),
            };
            report.error(name.span(), message, help);
            break;
        }
    }
    certificates
}

fn if_known(name: &Ident) -> String {
    format!(
        "if you know that it is, write `#[assume] invariant {name} = …`; else declare it as `monitor`"
    )
}

/// A constant of all motions has no zero to be crossed.
fn events(checked: &Checked, lowered: &Lowered, report: &mut Report) {
    let (dag, moving) = (&lowered.model.dag, Dependence::Q.0 | Dependence::P.0);
    let moving = Dependence(moving | Dependence::TIME.0);
    for (declared, observable) in checked.observables.iter().zip(&lowered.model.observables) {
        let is_still = |value: &Node| !dag.dependence(*value).on(moving);
        if declared.kind == ObservableKind::Event && observable.components.iter().all(is_still) {
            let name = &declared.name;
            report.error(
                name.span(),
                format!("`{name}` never changes along an orbit"),
                "write a function of coordinates, momenta or time: the event is where it is 0",
            );
        }
    }
}

/// Proves that the pieces add up to H. A definition in other coordinates is compared in these, with its
/// loops taken apart as the coordinates need.
pub fn split(checked: &Checked, model: &mut Model, report: &mut Report) {
    let Some((first, _)) = checked.split.first() else {
        return;
    };
    let pieces = model.split.clone();
    if let Err(difference) = check_split(model, &pieces) {
        let text = shortened(&difference.text);
        match &difference.point {
            Some((point, value)) => report.error(
                first.span(),
                format!(
                    "the pieces do not add up to H: H minus their sum is `{text}`, which is {} at {}",
                    readable(*value),
                    listed(point)
                ),
                "change the pieces so that their sum is H",
            ),
            None if checked.split_assumed => {}
            None => report.error(
                first.span(),
                format!(
                    "it is neither proven nor disproven that the pieces add up to H: H minus their sum is `{text}`; {}",
                    difference.why
                ),
                "if you know that they do, write `#[assume] split { … }`; else write them with the sums of H",
            ),
        }
    }
}

/// A formula, cut off where nobody would read on.
fn shortened(formula: &str) -> String {
    const LENGTH: usize = 200;
    match formula.char_indices().nth(LENGTH) {
        Some((end, _)) => format!("{}…", &formula[..end]),
        None => formula.to_owned(),
    }
}

/// A number to the digits one reads.
fn readable(value: f64) -> String {
    if (1e-3..1e6).contains(&value.abs()) {
        format!("{value:.6}")
    } else {
        format!("{value:.5e}")
    }
}

/// `q = 0.5, p = -1.25`
fn listed(point: &SamplePoint) -> String {
    let mut values: Vec<String> = Vec::new();
    for (name, value) in point {
        let value = format!("{name} = {value}");
        if !values.contains(&value) {
            values.push(value);
        }
    }
    if values.is_empty() {
        "every point".to_owned()
    } else {
        values.join(", ")
    }
}
