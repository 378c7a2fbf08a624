//! Who needs a derivative that is not there.
//!
//! Input: the functions wanted of a model that could not be derived. Output: an error at each
//! statement that needs a second derivative of a Rust function which came without one. Invariant:
//! the statement is the one that asks, not H, which others only read.

use super::definition;
use crate::checked::Checked;
use crate::report::{Report, Spans};
use hamiltonian_symbolic::dag::{Kind, Part};
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::pipeline;
use hamiltonian_symbolic::program::Purpose;

/// Reports who needs second derivatives that were not given.
pub fn second_derivatives(
    checked: &Checked,
    model: &mut Model,
    wanted: &[Purpose],
    report: &mut Report,
) {
    let mut blamed: Vec<String> = Vec::new();
    let mut gradient = None;
    for purpose in wanted {
        let roots = pipeline::request(model, *purpose, &mut gradient).roots();
        let missing = model.dag.reachable(&roots).into_iter().find_map(|node| {
            let Kind::External(function, Part::Second(..), _) = model.dag.kind(node) else {
                return None;
            };
            let external = &model.externals[usize::from(*function)];
            (!external.second).then(|| external.name.clone())
        });
        let Some(function) = missing else { continue };
        let (spans, what) = asker(checked, model, *purpose);
        // A monitor that has the derivative in it has it in its gradient too.
        if blamed.contains(&what) {
            continue;
        }
        report.error(
            spans,
            format!("{what} needs a second derivative of `{function}`"),
            format!(
                "give the second partials after the first: `fn {function}(x) = f, (df), (ddf)`"
            ),
        );
        blamed.push(what);
    }
}

/// Where a purpose comes from, and its name.
fn asker(checked: &Checked, model: &Model, purpose: Purpose) -> (Spans, String) {
    let observable = match purpose {
        Purpose::Observable(at) => checked.observables.get(usize::from(at)),
        Purpose::Vector(at) => {
            let name = &model.vectors[usize::from(at)].name;
            let of = name.strip_suffix("_gradient");
            of.and_then(|of| checked.observables.iter().find(|o| o.name == of))
        }
        _ => None,
    };
    match (observable, purpose, checked.force.first()) {
        (Some(observable), ..) => (
            observable.name.span().into(),
            format!("`{}`", observable.name),
        ),
        (None, Purpose::Vector(at), Some(force))
            if model.vectors[usize::from(at)].name == "force" =>
        {
            (checked.node(*force).spans, "the force".to_owned())
        }
        _ => (definition(checked), "H".to_owned()),
    }
}
