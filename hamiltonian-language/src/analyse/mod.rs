//! From a checked definition to its systems: proven, in their final variables, split, each with its program.
//!
//! Input: [`Checked`]. Output: [`Analysis`]; faults of the mathematics go into the report. Invariant: if anything is
//! reported, there is no analysis. A macro makes code of it, and any other program may interpret it.

mod blame;
pub mod described;
mod docs;
pub mod proofs;
pub mod splits;
pub mod structure;
pub mod surface;
pub mod variables;
mod verdicts;

use crate::check::SHARE_LOOPS;
use crate::checked::{Checked, Definition};
use crate::lower::{Beyond, ends, lower};
use crate::report::{Report, Spans};
use hamiltonian_symbolic::dag::{Kind, Node};
use hamiltonian_symbolic::halves::are_apart;
use hamiltonian_symbolic::index::LOOPS;
use hamiltonian_symbolic::legendre::Readable;
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::pipeline::{self, CAP, NoProgram};
use hamiltonian_symbolic::program::{Program, Purpose};
use hamiltonian_symbolic::structure as proven;
use proc_macro2::Ident;
use structure::{FieldSource, GradientSource, Kick, Text, Verdicts};
use surface::Default;
use variables::{Changed, Declared};

/// The sentence of the docs on an H that jumps.
const JUMPS: &str = "H or the force jumps at times that do not depend on the state. If steps end at these times, every scheme \
    that accepts the system keeps its order.";

/// Past this many nodes H is large.
const LARGE: usize = 1000;

/// All that is known of a definition.
#[derive(Debug)]
pub struct Analysis {
    /// The defaults of the parameters, number by number.
    pub defaults: Vec<Option<Default>>,
    /// Of each observable the sentences about its proof.
    pub proofs: Vec<Vec<String>>,
    /// The pieces that are systems of their own.
    pub pieces: Vec<(Ident, Node)>,
    /// The variables it was declared in, where it is integrated in others.
    pub declared: Option<Declared>,
    /// The systems of these pieces.
    pub of_pieces: Vec<System>,
    /// The whole system.
    pub whole: System,
}

/// The mathematics of one system, with its program.
#[derive(Debug)]
pub struct System {
    /// The mathematics.
    pub model: Model,
    /// The instructions.
    pub program: Program,
    /// The source of the gradient. The derivatives of the gradient over dual numbers are the Hessian if the program has no
    /// function for it.
    pub gradient: GradientSource,
    /// The source of the vector field.
    pub field: FieldSource,
    /// The proven structure.
    pub structure: Verdicts,
    /// The printed text.
    pub text: Text,
}

/// Analyses a definition.
pub fn analyse(checked: &Checked, report: &mut Report) -> Option<Analysis> {
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
    let assumed: Vec<bool> = checked.observables.iter().map(|of| of.assumed).into_list();
    let proofs = docs::proofs(&certificates, &assumed);
    let beyond = std::mem::take(&mut lowered.beyond);
    let Changed {
        model,
        pieces,
        declared,
    } = variables::change(checked, lowered, report)?;
    let mut of_pieces = Vec::with_capacity(pieces.len());
    for (name, hamiltonian) in &pieces {
        let part = Part {
            piece: Some(name),
            ..Part::default()
        };
        let model = surface::piece_model(&model, *hamiltonian);
        of_pieces.push(system(checked, &beyond, model, part, report)?);
    }
    let part = Part {
        piece: None,
        pieces: &pieces,
        readable: readable.as_ref(),
    };
    let whole = system(checked, &beyond, model, part, report)?;
    report.barrier(Analysis {
        defaults,
        proofs,
        pieces,
        declared,
        of_pieces,
        whole,
    })
}

/// The definition's own system, or a piece of its split.
#[derive(Debug, Default)]
struct Part<'a> {
    /// The name of the piece.
    piece: Option<&'a Ident>,
    /// The pieces that were declared.
    pieces: &'a [(Ident, Node)],
    /// Its formulas for reading, where they are others than those computed.
    readable: Option<&'a Readable>,
}

/// The analysis of one system.
fn system(
    checked: &Checked,
    beyond: &Beyond,
    mut model: Model,
    part: Part,
    report: &mut Report,
) -> Option<System> {
    let operations = operations(&model);
    if operations > CAP {
        too_large(checked, operations, report);
        return None;
    }
    let structure = proven::analyse(&mut model);
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
    let has_loops = has_loops(&model);
    let gradient = match has_loops && !large && model.force.is_empty() {
        false => GradientSource::Written,
        true if structure.separable.is_ok() => GradientSource::Halves,
        true => GradientSource::Field,
    };
    let wanted = wanted(checked, &model, [large, has_loops], gradient, &structure);
    let program = derive(checked, beyond, &mut model, wanted, report)?;
    text.operations = docs::operations(&model, &program);
    limit(checked, &program, report);
    Some(System {
        field: source_of_field(&program, gradient, &structure),
        model,
        program,
        gradient,
        structure,
        text,
    })
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

/// Returns true if H has loops. Each function more is then many lines: the gradient comes from the kick and the drift or
/// from the field, which have the same loops, and the Hessian from the gradient over dual numbers. Without loops,
/// functions of their own take fewer operations.
fn has_loops(model: &Model) -> bool {
    let is_loop = |node: &Node| matches!(model.dag.kind(*node), Kind::Reduce(..));
    model.dag.reachable(&[model.h()]).iter().any(is_loop)
}

/// The source of the field: the kick and the drift, if they share no work.
fn source_of_field(
    program: &Program,
    gradient: GradientSource,
    verdicts: &Verdicts,
) -> FieldSource {
    let halves = [Purpose::Kick, Purpose::Drift];
    let is_in_halves = gradient == GradientSource::Halves
        || verdicts.separable.is_ok()
            && verdicts.kick == Some(Kick::Plain)
            && are_apart(program, Purpose::VectorField, halves);
    match program.function(Purpose::VectorField) {
        _ if is_in_halves => FieldSource::Halves,
        Some(_) => FieldSource::Whole,
        None => FieldSource::OfGradient,
    }
}

/// The functions of a system, without those that the gradient can stand in for in a large one or in loops.
fn wanted(
    checked: &Checked,
    model: &Model,
    [large, has_loops]: [bool; 2],
    gradient: GradientSource,
    verdicts: &Verdicts,
) -> Vec<Purpose> {
    let mut wanted = vec![
        Purpose::Energy,
        Purpose::EnergyAndGradient,
        Purpose::TimeDerivative,
    ];
    if !has_loops {
        wanted.push(Purpose::HessianVector);
    }
    if !large && gradient == GradientSource::Written {
        wanted.extend([Purpose::GradientQ, Purpose::GradientP, Purpose::Gradient]);
    }
    // The gradient does not contain the force.
    if !model.force.is_empty() || !large && gradient != GradientSource::Halves {
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

/// The program, without H's own second derivatives if they have third ones of a Rust function.
fn derive(
    checked: &Checked,
    beyond: &Beyond,
    model: &mut Model,
    mut wanted: Vec<Purpose>,
    report: &mut Report,
) -> Option<Program> {
    let mut blamed = Vec::new();
    loop {
        match pipeline::derive(model, &wanted) {
            Ok(program) => return Some(program),
            Err(NoProgram::ThirdDerivative { purpose, function }) => {
                wanted.retain(|other| *other != purpose);
                if purpose != Purpose::HessianVector {
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
                blame::number(checked, &number, beyond, report);
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
