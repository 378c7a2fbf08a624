//! The place at which a program that could not be derived fails.
//!
//! Input: the purpose that needs a third derivative of a Rust function, or the number outside the range of `f64`.
//! Output: an error at the statement that needs the function, or at the expression that makes the number. Invariant:
//! the narrowest place that is known.

use super::definition;
use crate::checked::{Checked, NodeId};
use crate::lower::Beyond;
use crate::report::{Report, Spans};
use hamiltonian_symbolic::model::{Model, VectorUse};
use hamiltonian_symbolic::overflow::OutOfRange;
use hamiltonian_symbolic::program::Purpose;

/// Reports that a purpose needs a third derivative of `function`. `blamed` are the statements that did
/// already: a monitor that has the derivative in it has it in its gradient too.
pub fn third_derivative(
    checked: &Checked,
    model: &Model,
    (purpose, function): (Purpose, &str),
    blamed: &mut Vec<String>,
    report: &mut Report,
) {
    let (spans, what) = asker(checked, model, purpose);
    if blamed.contains(&what) {
        return;
    }
    report.error(
        spans,
        format!("{what} needs a third derivative of `{function}`, and Rust functions have two"),
        format!("write it in the language: `let {function}(x) = …`"),
    );
    blamed.push(what);
}

/// Reports a number past the range of `f64` at the innermost expression that makes it; a derivative
/// may make one that is written nowhere.
pub fn number(checked: &Checked, number: &OutOfRange, beyond: &Beyond, report: &mut Report) {
    let same = |(other, _): &&(OutOfRange, NodeId)| match (number, other) {
        (OutOfRange::Number(number), OutOfRange::Number(other)) => number.abs() == other.abs(),
        (number, other) => number == other,
    };
    let place = beyond.iter().find(same).or(beyond.first());
    let spans = place.map_or(definition(checked), |(_, node)| checked.node(*node).spans);
    let message = match number.is_small() {
        true => "a number here is smaller than any f64 but not 0",
        false => "a number here is larger than any f64",
    };
    report.error(
        spans,
        message,
        "numbers are exact until the end, and then must lie between 1e-323 and 1.7e308: choose other units",
    );
}

/// The origin of a purpose, and its name.
fn asker(checked: &Checked, model: &Model, purpose: Purpose) -> (Spans, String) {
    let usage = match purpose {
        Purpose::Vector(at) => Some(model.vectors[usize::from(at)].usage),
        _ => None,
    };
    let observable = match (purpose, usage) {
        (Purpose::Observable(at), _) => usize::from(at),
        (_, Some(VectorUse::Gradient(at))) => at,
        (_, Some(VectorUse::Force)) => {
            let force = checked.node(checked.force[0]);
            return (force.spans, "the force".to_owned());
        }
        _ => return (definition(checked), "H".to_owned()),
    };
    let name = &checked.observables[observable].name;
    (name.span().into(), format!("`{name}`"))
}
