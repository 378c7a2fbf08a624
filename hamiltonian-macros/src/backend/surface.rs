//! The user's tokens, as emission reads them.
//!
//! Input: [`Checked`]. Output: the header, the observables and the functions in the model's
//! numbering. Invariant: tokens keep their spans.

use crate::checked::{self, Checked, Definition, SizeKind, Type};
use crate::emit::{
    self, Declared, Field, Form, Item, ObservableItem, ParameterItem, SizeItem, VectorItem,
};
use crate::lower::constants;
use crate::report::Report;
use hamiltonian_symbolic::dag::Dependence;
use hamiltonian_symbolic::dag::Node;
use hamiltonian_symbolic::diff;
use hamiltonian_symbolic::model::{Model, ObservableKind};
use hamiltonian_symbolic::print::Readable;
use proc_macro2::Ident;
use quote::{format_ident, quote};

/// The defaults of the parameters, number by number, as expressions of the scalar `T`.
pub type Defaults = Vec<Option<Vec<String>>>;

/// The defaults as they are emitted.
pub fn defaults(checked: &Checked, report: &mut Report) -> Option<Defaults> {
    let mut all = Vec::with_capacity(checked.parameters.len());
    for parameter in &checked.parameters {
        let Some(roots) = &parameter.default else {
            all.push(None);
            continue;
        };
        let (dag, values) = constants(checked, roots, report)?;
        let mut numbers = Vec::with_capacity(values.len());
        for (value, root) in values.into_iter().zip(roots) {
            let spans = checked.node(*root).spans;
            if dag.leaves_f64(value) {
                let message = format!("the default of `{}` does not fit an f64", parameter.name);
                report.error(spans, message, "write a number between 1e-323 and 1.7e308");
                return None;
            }
            let Some(text) = emit::closed(&dag, value) else {
                report.internal(spans, "a default is not made of numbers alone");
                return None;
            };
            numbers.push(text);
        }
        all.push(Some(numbers));
    }
    Some(all)
}

/// The header, or the captured names.
pub fn form(checked: &Checked, defaults: &Defaults) -> Form {
    let Some(item) = &checked.item else {
        return Form::Expression(checked.captures.clone());
    };
    Form::Item(Item {
        attributes: item.attributes.clone(),
        visibility: item.visibility.clone(),
        name: item.name.clone(),
        whole: None,
        sizes: checked
            .sizes
            .iter()
            .map(|size| SizeItem {
                name: size.name.clone(),
                run_time: size.kind == SizeKind::Runtime,
                attributes: size.attributes.clone(),
            })
            .collect(),
        parameters: checked
            .parameters
            .iter()
            .zip(defaults)
            .map(|(parameter, default)| ParameterItem {
                name: parameter.name.clone(),
                attributes: parameter.attributes.clone(),
                default: default.clone(),
            })
            .collect(),
        fields: item
            .fields
            .iter()
            .map(|field| match field {
                checked::Field::Size(size) => Field::Size(size.0 as usize),
                checked::Field::Parameter(parameter) => Field::Parameter(parameter.0 as usize),
            })
            .collect(),
    })
}

/// Names and docs of observables.
pub fn observables(checked: &Checked) -> Vec<ObservableItem> {
    let observables = checked.observables.iter().map(|observable| ObservableItem {
        name: observable.name.clone(),
        attributes: observable.attributes.clone(),
    });
    observables.collect()
}

/// Whether ∂H/∂q is free of momenta and ∂H/∂p of coordinates as H is written. Neither says so
/// alone: a condition couples without a derivative.
pub fn separates_as_written(model: &mut Model) -> bool {
    let h = model.h();
    let mut is_free = |by: Dependence, of: Dependence| {
        let adjoints = diff::gradient(&mut model.dag, h, by);
        adjoints
            .iter()
            .all(|(_, value)| !model.dag.dependence(*value).on(of))
    };
    is_free(Dependence::Q, Dependence::P) && is_free(Dependence::P, Dependence::Q)
}

/// The user's tokens for one system.
#[derive(Debug)]
pub struct Part {
    /// Its header.
    pub form: Form,
    /// Its observables.
    pub observables: Vec<ObservableItem>,
    /// Its vector functions.
    pub vectors: Vec<VectorItem>,
    /// The pieces of its split and their types.
    pub pieces: Vec<(Ident, Ident)>,
    /// Whether it is a piece of a split.
    pub is_piece: bool,
    /// The variables it was declared in, where it is integrated in others.
    pub declared: Option<Declared>,
    /// Its formulas for reading, where they are others than those computed.
    pub readable: Option<Readable>,
}

impl Part {
    /// The system of the definition.
    pub fn whole(
        checked: &Checked,
        vectors: Vec<VectorItem>,
        pieces: &[(Ident, Node)],
        declared: Option<Declared>,
        defaults: &Defaults,
    ) -> Part {
        let pieces = pieces
            .iter()
            .map(|(name, _)| (name.clone(), type_of(checked, name)));
        Part {
            form: form(checked, defaults),
            observables: observables(checked),
            vectors,
            pieces: pieces.collect(),
            is_piece: false,
            declared,
            readable: None,
        }
    }

    /// A piece of its split: a type of its own with the same parameters.
    pub fn piece(checked: &Checked, name: &Ident, defaults: &Defaults) -> Part {
        let mut form = form(checked, defaults);
        if let Form::Item(item) = &mut form {
            let text = format!(" The piece `{name}` of the split of [`{}`].", item.name);
            item.attributes = vec![quote! { #[doc = #text] }];
            item.whole = Some(item.name.clone());
            item.name = type_of(checked, name);
        }
        Part {
            form,
            observables: Vec::new(),
            vectors: Vec::new(),
            pieces: Vec::new(),
            is_piece: true,
            declared: None,
            readable: None,
        }
    }
}

/// The type of a piece.
fn type_of(checked: &Checked, piece: &Ident) -> Ident {
    match &checked.item {
        Some(item) => format_ident!("{}{}", item.name, piece, span = piece.span()),
        None => piece.clone(),
    }
}

/// The model of a piece.
pub fn piece_model(model: &Model, hamiltonian: Node) -> Model {
    let mut model = model.clone();
    model.hamiltonian = Some(hamiltonian);
    // The force acts on the whole.
    model.force.clear();
    model.observables.clear();
    model.vectors.clear();
    model.pieces.clear();
    model
}

/// An H whose momenta cancel.
pub fn refuse_motionless(checked: &Checked, model: &Model, report: &mut Report) {
    if let Definition::Hamiltonian(root) = &checked.definition
        && !model.dag.dependence(model.h()).on(Dependence::P)
    {
        report.error(
            checked.node(*root).spans,
            "`H` depends on no momentum: its momenta cancel",
            "nothing would move: write a kinetic energy, such as `p^2/2`",
        );
    }
}

/// Combinations that have no meaning.
pub fn refuse_unsupported(checked: &Checked, report: &mut Report) {
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
        methods.push("state_from_velocity".to_owned());
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
pub const CLOCK: &str = "Clock";

/// The method that gives a piece.
fn piece_method(piece: &str) -> String {
    format!("piece_{}", piece.to_lowercase())
}
