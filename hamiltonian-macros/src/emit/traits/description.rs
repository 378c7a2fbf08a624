//! The description of a definition, as a constant.
//!
//! Input: a definition. Output: text of `__DESCRIPTION`, which the system and its prepared form return. Invariant: the
//! pieces stand in the order of `Split::pieces`.

use crate::emit::definition::{Nystrom, Structure};
use crate::emit::names::context::Context;
use crate::emit::names::layout::Layout;
use hamiltonian_symbolic::dag::Dependence;
use hamiltonian_symbolic::model::{Model, Shape};
use hamiltonian_symbolic::print;
use std::fmt::Write;

/// The constant.
pub fn constant(context: Context) -> String {
    let (model, structure) = (context.model, &context.definition.structure);
    let time = match &model.evolution {
        Some(time) => format!("__h::Option::Some(__h::Cow::Borrowed({time:?}))"),
        None => "__h::Option::None".to_owned(),
    };
    let growth = match structure.growth {
        Some(power) => format!("__h::Option::Some({power})"),
        None => "__h::Option::None".to_owned(),
    };
    format!(
        "__h::described! {{\n{:?}, {:?}, {}, {growth}, {:?}, {time};\n[{}] [{}] [{}] [{}]\n}}\n",
        model.name,
        formula(context),
        !model.force.is_empty(),
        jumps(structure),
        groups(model, context.layout),
        observables(model),
        quoted(&structure.cyclic),
        pieces(context),
    )
}

fn quoted(names: &[String]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("{name:?}")).collect();
    names.join(", ")
}

/// H in the author's notation, and the force.
fn formula(context: Context) -> String {
    let model = context.model;
    let mut formula = context.definition.text.hamiltonian.clone();
    for force in &model.force {
        let momentum = model.groups[usize::from(force.at.group)].name(force.at.side);
        let value = print::text(model, force.value);
        let _ = write!(
            formula,
            "; force on {momentum}, column {}: {value}",
            force.at.column
        );
    }
    formula
}

/// True if the kick jumps in time, and the same for the rest of H.
fn jumps(structure: &Structure) -> [bool; 2] {
    let Some(jumping) = &structure.jumping else {
        return [false; 2];
    };
    match &structure.nystrom {
        _ if structure.separable.is_ok() => jumping.halves,
        Ok(Nystrom::Pieces(numbers)) => numbers.map(|number| jumping.pieces[number]),
        _ => [true; 2],
    }
}

/// The pieces, in the order of `Split::pieces`.
fn pieces(context: Context) -> String {
    let (structure, model) = (&context.definition.structure, context.model);
    if structure.split.is_err() {
        return String::new();
    }
    let entry = |name: &str, formula: &str, jumps: bool| {
        format!("__h::piece({name:?}, {formula:?}, {jumps})")
    };
    let halves = structure.jumping.as_ref().map(|jumping| jumping.halves);
    let halves = halves.unwrap_or_default();
    let mut all: Vec<String> = Vec::new();
    if model.pieces.is_empty() {
        let half = |at: usize| {
            let text = &structure.halves[at];
            entry(text, text, halves[at])
        };
        all = [0, 1].map(half).into();
        if structure.is_drift_first() {
            all.reverse();
        }
    }
    let jumping = structure.jumping.as_ref();
    let jumps = |at: usize| jumping.is_some_and(|jumping| jumping.pieces[at]);
    for (at, piece) in model.pieces.iter().enumerate() {
        all.push(entry(&piece.name, &print::text(model, piece.h), jumps(at)));
    }
    if structure.is_forced_apart() {
        let force = &structure.halves[0];
        all.push(entry(force, force, jumps(model.pieces.len())));
    }
    all.join(", ")
}

fn observables(model: &Model) -> String {
    let mut out = Vec::new();
    for observable in &model.observables {
        let kind = observable.kind;
        for (component, node) in observable.components.iter().enumerate() {
            let name = if observable.components.len() == 1 {
                observable.name.clone()
            } else {
                format!("{}[{component}]", observable.name)
            };
            let dependence = model.dag.dependence(*node);
            let reads = [Dependence::Q, Dependence::P].map(|half| dependence.on(half));
            let timed = dependence.on(Dependence::TIME);
            out.push(format!(
                "__h::observable(__h::ObservableKind::{kind:?}, {name:?}, {timed}, {reads:?})"
            ));
        }
    }
    out.join(", ")
}

fn groups(model: &Model, layout: Layout) -> String {
    let mut out = Vec::new();
    for (at, group) in model.groups.iter().enumerate() {
        let columns = group.shape.columns();
        let rank = match &group.shape {
            Shape::Lattice(_, axes) => axes.len(),
            Shape::Scalar => 0,
            Shape::Vector(_) => 1,
            Shape::Matrix(..) => 2,
        };
        let (part, offset) = match layout {
            Layout::Scalars => (0, at),
            Layout::Array => (0, 0),
            Layout::Mixed => (at, 0),
        };
        let (coordinate, momentum) = (&group.coordinate, &group.momentum);
        out.push(format!(
            "__h::group({coordinate:?}, {momentum:?}, [{rank}, {part}, {offset}, {columns}])"
        ));
    }
    out.join(", ")
}
