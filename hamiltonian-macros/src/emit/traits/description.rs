//! The description of a definition, as a constant.
//!
//! Input: a definition. Output: text of `__DESCRIPTION`, which the system and its prepared form return. Invariant: the
//! pieces stand in the order of `Split::pieces`.

use crate::emit::names::context::Context;
use crate::emit::names::layout::Layout;
use hamiltonian_language::analyse::described::{Described, DescribedObservable, DescribedPiece};
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::model::{Model, Shape};

/// The constant.
pub fn constant(context: Context) -> String {
    let (model, structure) = (context.model, &context.definition.structure);
    let described = Described::of(model, structure, context.definition.text);
    let time = match &model.evolution {
        Some(time) => format!("__h::Option::Some(__h::Cow::Borrowed({time:?}))"),
        None => "__h::Option::None".to_owned(),
    };
    let growth = match structure.growth {
        Some(power) => format!("__h::Option::Some({power})"),
        None => "__h::Option::None".to_owned(),
    };
    format!(
        "__h::described! {{\n{:?}, {:?}, {}, {}, {growth}, {:?}, {time};\n[{}] [{}] [{}] [{}]\n}}\n",
        model.name,
        described.formula,
        !model.force.is_empty(),
        structure.autonomous.is_ok(),
        described.jumps,
        groups(model, context.layout),
        observables(&described),
        quoted(&structure.cyclic),
        pieces(&described),
    )
}

fn quoted(names: &[String]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("{name:?}")).into_list();
    names.join(", ")
}

fn pieces(described: &Described) -> String {
    let entry = |piece: &DescribedPiece| {
        let DescribedPiece {
            name,
            formula,
            jumps,
        } = piece;
        format!("__h::piece({name:?}, {formula:?}, {jumps})")
    };
    let all: Vec<String> = described.pieces.iter().map(entry).into_list();
    all.join(", ")
}

fn observables(described: &Described) -> String {
    let entry = |observable: &DescribedObservable| {
        let DescribedObservable {
            kind,
            name,
            timed,
            reads,
        } = observable;
        format!("__h::observable(__h::ObservableKind::{kind:?}, {name:?}, {timed}, {reads:?})")
    };
    let all: Vec<String> = described.observables.iter().map(entry).into_list();
    all.join(", ")
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
