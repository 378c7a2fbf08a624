//! From a checked definition to code: the stages of the back end in order.
//!
//! Input: [`Checked`] and the path by which emitted code reaches the library. Output: items or an
//! expression, if they could be made; faults of the mathematics go into the report.
//! Invariant: if anything is reported, the result is dropped for the stub.

mod blame;
mod docs;
pub mod proofs;
mod splits;
mod surface;
mod variables;
mod verdicts;

use crate::emit::{self, Gradient};
use hamiltonian_language::check::SHARE_LOOPS;
use hamiltonian_language::checked::{Checked, Definition};
use hamiltonian_language::lower::{Beyond, ends, lower};
use hamiltonian_language::report::{Report, Spans};
use hamiltonian_symbolic::dag::{Kind, Node};
use hamiltonian_symbolic::index::LOOPS;
use hamiltonian_symbolic::legendre::Readable;
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::pipeline::{self, CAP, NoProgram};
use hamiltonian_symbolic::program::{Program, Purpose};
use hamiltonian_symbolic::structure;
use proc_macro2::{Ident, TokenStream};
use variables::System;

/// The sentence of the docs on an H that jumps.
const JUMPS: &str = "H or the force jumps at times that do not depend on the state. If steps end at these times, every scheme \
    that accepts the system keeps its order.";

/// Past this many nodes H is large.
const LARGE: usize = 1000;

/// The code of a definition. `root` is the path of the library; emitted code names only
/// `#root::private`.
pub fn generate(checked: &Checked, root: &TokenStream, report: &mut Report) -> Option<TokenStream> {
    let mut lowered = lower(checked, report)?;
    let certificates = proofs::prove(checked, &mut lowered, report);
    surface::refuse_unsupported(checked, report);
    report.barrier(())?;
    // In other variables than those of L, H is a formula like any other.
    let is_declared = checked.charts.is_empty() && checked.time_factor.is_none();
    let readable = lowered.legendre.as_ref().filter(|_| is_declared);
    let readable = readable.map(|legendre| Readable::of(&lowered.model, legendre));
    if ends::guard(&mut lowered).is_none() {
        let reason = "this Lagrangian has no Hamiltonian: the momentum of an element has a sum that starts below 0 for the first elements";
        let help = "let the sum start at 0, with a condition in it: `sum(j in 0..n) { if i <= j { … } else { 0 } }`; else give H(q; p)";
        report.error(definition(checked), reason.to_owned(), help);
        return None;
    }
    let defaults = surface::defaults(checked, report)?;
    let assumed: Vec<bool> = checked.observables.iter().map(|of| of.assumed).collect();
    let proofs = docs::proofs(&certificates, &assumed);
    let beyond = std::mem::take(&mut lowered.beyond);
    let System {
        model,
        pieces,
        declared,
    } = variables::change(checked, lowered, report)?;
    let frame = Frame {
        checked,
        root,
        defaults: &defaults,
        beyond: &beyond,
        proofs: &proofs,
    };
    let mut code = TokenStream::new();
    for (name, hamiltonian) in &pieces {
        let part = Part {
            piece: Some(name),
            ..Part::default()
        };
        let model = surface::piece_model(&model, *hamiltonian);
        code.extend(system(&frame, model, part, report)?);
    }
    let part = Part {
        piece: None,
        pieces: &pieces,
        declared: declared.as_ref(),
        readable: readable.as_ref(),
    };
    code.extend(system(&frame, model, part, report)?);
    Some(code)
}

/// The input that all systems of a definition share.
struct Frame<'a> {
    checked: &'a Checked,
    root: &'a TokenStream,
    defaults: &'a surface::Defaults,
    beyond: &'a Beyond,
    /// The proofs of the observables in words.
    proofs: &'a [Vec<String>],
}

/// The definition's own system, or a piece of its split.
#[derive(Debug, Default)]
struct Part<'a> {
    /// The name of the piece.
    piece: Option<&'a Ident>,
    /// The pieces that were declared.
    pieces: &'a [(Ident, Node)],
    /// The variables it was declared in, where it is integrated in others.
    declared: Option<&'a emit::Declared>,
    /// Its formulas for reading, where they are others than those computed.
    readable: Option<&'a Readable>,
}

/// The code of one system.
fn system(frame: &Frame, mut model: Model, part: Part, report: &mut Report) -> Option<TokenStream> {
    let checked = frame.checked;
    let operations = operations(&model);
    if operations > CAP {
        too_large(checked, operations, report);
        return None;
    }
    let structure = structure::analyse(&mut model);
    let large = is_large(checked, &model);
    let mut text = docs::text(&model, &structure, part.readable, large);
    if let Ok(split) = &structure.separable
        && !split.as_written
    {
        // A product such as (p + q)^2/2 - q*p separates only when multiplied out.
        model.hamiltonian = Some(model.dag.add(&[split.kinetic, split.potential]));
    }
    let large = is_large(checked, &model);
    let split = splits::decide(checked, &mut model, &structure, &part, report);
    text.facts.extend(split.facts);
    let structure = verdicts::verdicts(&mut model, &structure, split.verdict);
    if structure.jumping.is_some() {
        text.facts.push(JUMPS.to_owned());
    }
    let gradient = match large {
        true => Gradient::Written,
        false => source_of_gradient(&model, &structure),
    };
    let wanted = wanted(checked, &model, (large, gradient), &structure);
    let (program, third) = derive(frame, &mut model, wanted, report)?;
    text.operations = docs::operations(&model, &program);
    limit(checked, &program, report);
    Some(emit::generate(&emit::Definition {
        root: frame.root,
        checked,
        defaults: frame.defaults,
        proofs: frame.proofs,
        piece: part.piece,
        pieces: part.pieces,
        declared: part.declared,
        model: &model,
        program: &program,
        third: third.as_deref(),
        gradient,
        structure,
        text,
    }))
}

/// The operations of H by itself, each loop body counted once.
fn operations(model: &Model) -> usize {
    let count = |node: &Node| match model.dag.kind(*node) {
        Kind::Sum(_, terms) => terms.len().saturating_sub(1),
        Kind::Product(_, factors) => factors.len().saturating_sub(1),
        Kind::Call(..) | Kind::External(..) => 1,
        _ => 0,
    };
    model.dag.reachable(&[model.h()]).iter().map(count).sum()
}

fn too_large(checked: &Checked, operations: usize, report: &mut Report) {
    report.error(
        definition(checked),
        format!("this system needs {operations} operations, more than {CAP}"),
        "write sums with `sum(i in 0..N) { … }`: they stay loops unless they choose among components",
    );
}

/// The source of the gradient. Where H has loops, each function more is many lines, and the kick, the drift and the
/// field have the same loops as the gradient; without loops, functions of their own take fewer operations.
fn source_of_gradient(model: &Model, verdicts: &emit::Structure) -> Gradient {
    let is_loop = |node: &Node| matches!(model.dag.kind(*node), Kind::Reduce(..));
    let has_loops = model.dag.reachable(&[model.h()]).iter().any(is_loop);
    match (has_loops && model.force.is_empty(), &verdicts.separable) {
        (false, _) => Gradient::Written,
        (true, Ok(())) => Gradient::Halves,
        (true, Err(_)) => Gradient::Field,
    }
}

/// The functions of a system. Those of a large one that the gradient can stand in for are left out.
fn wanted(
    checked: &Checked,
    model: &Model,
    (large, gradient): (bool, Gradient),
    verdicts: &emit::Structure,
) -> Vec<Purpose> {
    let mut wanted = vec![
        Purpose::Energy,
        Purpose::EnergyAndGradient,
        Purpose::TimeDerivative,
        Purpose::HessianVector,
    ];
    if !large && gradient == Gradient::Written {
        wanted.extend([Purpose::GradientQ, Purpose::GradientP, Purpose::Gradient]);
    }
    // The gradient does not contain the force.
    if !model.force.is_empty() || !large && gradient != Gradient::Halves {
        wanted.push(Purpose::VectorField);
    }
    if let Some(kick) = verdicts.kick {
        wanted.extend(kick.purposes());
    }
    if verdicts.separable.is_ok() {
        wanted.push(Purpose::Drift);
    }
    if checked.item.is_some() && !checked.parameters.is_empty() {
        wanted.push(Purpose::ParameterGradient);
    }
    wanted.extend((0..model.pieces.len()).map(|at| Purpose::Piece(at as u16)));
    wanted.extend((0..model.observables.len()).map(|at| Purpose::Observable(at as u16)));
    wanted.extend((0..model.vectors.len()).map(|at| Purpose::Vector(at as u16)));
    wanted
}

/// Returns true if H is so long that emitting every function would cost rustc more than it gives.
fn is_large(checked: &Checked, model: &Model) -> bool {
    let is_static = checked.sizes.iter().all(|size| !size.run_time);
    is_static && model.dag.reachable(&[model.h()]).len() > LARGE
}

/// The program, without H's own second derivatives if they have third ones of a Rust function, whose name is returned.
fn derive(
    frame: &Frame,
    model: &mut Model,
    mut wanted: Vec<Purpose>,
    report: &mut Report,
) -> Option<(Program, Option<String>)> {
    let checked = frame.checked;
    let (mut blamed, mut third) = (Vec::new(), None);
    loop {
        match pipeline::derive(model, &wanted) {
            Ok(program) => return Some((program, third)),
            Err(NoProgram::ThirdDerivative { purpose, function }) => {
                wanted.retain(|other| *other != purpose);
                if purpose == Purpose::HessianVector {
                    third = Some(function);
                } else {
                    let asked = (purpose, function.as_str());
                    blame::third_derivative(checked, model, asked, &mut blamed, report);
                }
                continue;
            }
            Err(NoProgram::TooLarge { operations }) => too_large(checked, operations, report),
            Err(NoProgram::TooManyLoops) => report.error(
                definition(checked),
                format!("derivatives of this system need more than {LOOPS} loops"),
                SHARE_LOOPS,
            ),
            Err(NoProgram::Internal { fault }) => report.internal(definition(checked), &fault),
            Err(NoProgram::OutOfRange(number)) => {
                blame::number(checked, &number, frame.beyond, report);
            }
        }
        return None;
    }
}

/// The right side of H or L.
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
