//! The surface of a system: defaults, the model of a piece, and combinations that have no meaning.
//!
//! Input: [`Checked`]. Output: the defaults, models, errors. Invariant: all
//! methods of a type have different names.

use crate::checked::{Checked, Definition, Type};
use crate::lower::constants;
use crate::report::Report;
use hamiltonian_symbolic::dag::{Dag, Node};
use hamiltonian_symbolic::model::{Model, ObservableKind};
use proc_macro2::Ident;

/// The default of a parameter: expressions of numbers alone, one for each number.
#[derive(Debug)]
pub struct Default {
    /// Their arena.
    pub dag: Dag,
    /// The expressions.
    pub values: Vec<Node>,
}

/// The defaults of the parameters.
pub(super) fn defaults(checked: &Checked, report: &mut Report) -> Option<Vec<Option<Default>>> {
    let mut all = Vec::with_capacity(checked.parameters.len());
    for parameter in &checked.parameters {
        let Some(roots) = &parameter.default else {
            all.push(None);
            continue;
        };
        let (dag, values) = constants(checked, roots, report)?;
        for (value, root) in values.iter().zip(roots) {
            let spans = checked.node(*root).spans;
            if dag.out_of_range(&[*value]).is_some() {
                let message = format!("the default of `{}` does not fit an f64", parameter.name);
                report.error(spans, message, "write a number between 1e-323 and 1.7e308");
                return None;
            }
        }
        all.push(Some(Default { dag, values }));
    }
    Some(all)
}

/// The model of a piece.
pub(super) fn piece_model(model: &Model, hamiltonian: Node) -> Model {
    let mut model = model.clone();
    model.hamiltonian = Some(hamiltonian);
    // The force acts on the whole.
    model.force.clear();
    model.observables.clear();
    model.vectors.clear();
    model.pieces.clear();
    model
}

/// Combinations that have no meaning.
pub(super) fn refuse_unsupported(checked: &Checked, report: &mut Report) {
    if let (None, Some((name, _))) = (&checked.item, checked.split.first()) {
        report.error(
            name.span(),
            "the pieces of a split are types, which a value cannot declare",
            "use the item form: `pub struct Name {} H = …; split { … }`",
        );
    }
    refuse_same_methods(checked, report);
}

/// Methods whose names follow from those of the definition must differ too.
fn refuse_same_methods(checked: &Checked, report: &mut Report) {
    let mut methods: Vec<String> = Vec::new();
    if checked.item.is_some() && !checked.parameters.is_empty() {
        methods.push("parameter_gradient".to_owned());
    }
    if checked.time_factor.is_some() {
        methods.extend([piece_method(CLOCK), "on_shell".to_owned()]);
    }
    if !checked.charts.is_empty() || checked.time_factor.is_some() {
        methods.extend(["from_declared", "to_declared"].map(str::to_owned));
    }
    if matches!(checked.definition, Definition::Lagrangian(_)) {
        methods.extend(["state_from_velocity", "state_from_velocity_over"].map(str::to_owned));
    }
    let mut add = |name: &Ident, method: String| {
        if methods.contains(&method) {
            let message = if *name == method {
                format!("`{name}` is a method of this system already")
            } else {
                format!("`{name}` makes a method `{method}`, which there is already")
            };
            report.error(name.span(), message, "choose another name");
        }
        methods.push(method);
    };
    for (name, _) in &checked.split {
        add(name, piece_method(&name.to_string()));
    }
    for observable in &checked.observables {
        add(&observable.name, observable.name.to_string());
    }
    for observable in &checked.observables {
        let is_vector = matches!(checked.node(observable.value).ty, Type::Vector(_));
        if observable.kind != ObservableKind::Invariant && !is_vector {
            add(&observable.name, format!("{}_gradient", observable.name));
        }
    }
}

/// The piece that carries time along where `dt = g*ds` makes time a coordinate.
pub(super) const CLOCK: &str = "Clock";

/// The method that gives a piece.
pub fn piece_method(piece: &str) -> String {
    format!("piece_{}", piece.to_lowercase())
}
