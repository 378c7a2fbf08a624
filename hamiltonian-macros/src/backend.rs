//! Checked definition → code: the back end on one screen.
//!
//! Input: [`Checked`] and the path by which emitted code reaches the library. Output: items or an
//! expression; what is wrong with the mathematics goes into the report. Invariant: if anything is
//! reported, the result is dropped for the stub.

mod docs;
mod surface;
mod verdicts;

use crate::checked::{Checked, Definition};
use crate::emit;
use crate::lower::lower;
use crate::report::{Report, Spans};
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::pipeline::{self, CAP, Refusal};
use hamiltonian_symbolic::program::{Program, Purpose};
use hamiltonian_symbolic::structure::{self, Structure};
use proc_macro2::TokenStream;

/// The code of a definition. `root` is the path of the library; emitted code names only
/// `#root::private`.
pub fn generate(checked: &Checked, root: &TokenStream, report: &mut Report) -> TokenStream {
    surface::refuse_unsupported(checked, report);
    let mut code = || {
        report.barrier(())?;
        let mut model = lower(checked, report)?;
        let structure = structure::analyse(&mut model);
        let text = docs::text(&model, &structure);
        let program = derive(checked, &mut model, &structure, report)?;
        limit(checked, &program, report);
        let definition = emit::Definition {
            root: root.clone(),
            form: surface::form(checked),
            structure: verdicts::verdicts(&model, &structure),
            externals: surface::externals(checked),
            observables: surface::observables(checked),
            model: &model,
            program: &program,
            text,
        };
        Some(emit::generate(&definition))
    };
    code().unwrap_or_default()
}

/// The functions of a system.
fn wanted(checked: &Checked, separable: bool) -> Vec<Purpose> {
    let mut wanted = vec![
        Purpose::Energy,
        Purpose::GradientQ,
        Purpose::GradientP,
        Purpose::Gradient,
        Purpose::EnergyAndGradient,
        Purpose::TimeDerivative,
        Purpose::HessianVector,
        Purpose::Flow,
    ];
    if separable {
        wanted.extend([Purpose::Kick, Purpose::Drift]);
    }
    if checked.item.is_some() && !checked.parameters.is_empty() {
        wanted.push(Purpose::ParameterGradient);
    }
    wanted.extend((0..checked.observables.len()).map(|at| Purpose::Observable(at as u16)));
    wanted
}

/// The program, without second derivatives where a Rust function came without them.
fn derive(
    checked: &Checked,
    model: &mut Model,
    structure: &Structure,
    report: &mut Report,
) -> Option<Program> {
    if let Ok(split) = &structure.separable {
        // A product such as (p + q)^2/2 - q*p separates only when multiplied out.
        let split = model.dag.add(&[split.kinetic, split.potential]);
        if !surface::separates_as_written(model) {
            model.hamiltonian = Some(split);
        }
    }
    let mut wanted = wanted(checked, structure.separable.is_ok());
    let refusal = match pipeline::derive(model, &wanted) {
        Err(Refusal::NoSecondDerivative { .. }) => {
            wanted.retain(|purpose| *purpose != Purpose::HessianVector);
            pipeline::derive(model, &wanted)
        }
        result => result,
    };
    let (message, help) = match refusal {
        Ok(program) => return Some(program),
        Err(Refusal::TooLarge { operations }) => (
            format!("a function of this system needs {operations} operations, more than {CAP}"),
            "write sums with `sum(i in 0..N) { … }`, which stay loops".to_owned(),
        ),
        Err(Refusal::TooManyLoops) => (
            "derivatives of this system need more than 64 loops".to_owned(),
            "let several sums share a loop".to_owned(),
        ),
        Err(Refusal::NoSecondDerivative { function }) => (
            format!("a second derivative of `{function}` is needed"),
            format!(
                "give the second partials after the first: `fn {function}(x) = f, (df), (ddf)`"
            ),
        ),
    };
    report.error(definition(checked), message, help);
    None
}

/// Where H stands.
fn definition(checked: &Checked) -> Spans {
    let (Definition::Hamiltonian(root) | Definition::Lagrangian(root)) = checked.definition;
    checked.node(root).spans
}

/// `#[max_ops = 40]`
fn limit(checked: &Checked, program: &Program, report: &mut Report) {
    let Some((most, span)) = checked.item.as_ref().and_then(|item| item.max_ops) else {
        return;
    };
    let Some(function) = program.function(Purpose::EnergyAndGradient) else {
        return;
    };
    let count = program.operations(function).total();
    if count as u64 > most {
        report.error(
            span,
            format!("H with its gradient needs {count} operations, more than {most}"),
            format!("simplify H, or allow `#[max_ops = {count}]`"),
        );
    }
}
