//! What the user's tokens say, as emission reads it.
//!
//! Input: [`Checked`]. Output: the header, the observables and the functions in the model's
//! numbering. Invariant: tokens keep their spans.

use crate::checked::{self, Checked, Definition, SizeKind};
use crate::emit::{External, Field, Form, Item, ObservableItem, ParameterItem, SizeItem};
use crate::lower::number;
use crate::report::Report;
use hamiltonian_symbolic::dag::Dependence;
use hamiltonian_symbolic::diff;
use hamiltonian_symbolic::model::Model;

/// The header, or the captured names.
pub fn form(checked: &Checked) -> Form {
    let Some(item) = &checked.item else {
        return Form::Expression(checked.captures.clone());
    };
    Form::Item(Item {
        attributes: item.attributes.clone(),
        visibility: item.visibility.clone(),
        name: item.name.clone(),
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
            .map(|parameter| ParameterItem {
                name: parameter.name.clone(),
                attributes: parameter.attributes.clone(),
                default: parameter.default.as_ref().map(|default| {
                    let value = number(&default.number);
                    if default.negative { value.neg() } else { value }
                }),
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

/// Functions written in Rust.
pub fn externals(checked: &Checked) -> Vec<External> {
    let functions = checked.functions.iter().map(|function| External {
        value: function.value.clone(),
        first: function.first.clone(),
        second: function.second.clone(),
    });
    functions.collect()
}

/// Names and docs of observables.
pub fn observables(checked: &Checked) -> Vec<ObservableItem> {
    let observables = checked.observables.iter().map(|observable| ObservableItem {
        name: observable.name.clone(),
        attributes: observable.attributes.clone(),
    });
    observables.collect()
}

/// Whether ∂H/∂q is free of momenta as H is written.
pub fn separates_as_written(model: &mut Model) -> bool {
    let Some(h) = model.hamiltonian else {
        return true;
    };
    let adjoints = diff::gradient(&mut model.dag, h, Dependence::Q);
    adjoints
        .iter()
        .all(|(_, value)| !model.dag.dependence(*value).on(Dependence::P))
}

/// Statements that are part of the language and that this version checks but cannot compile.
pub fn refuse_unsupported(checked: &Checked, report: &mut Report) {
    let mut refuse = |spans: crate::report::Spans, what: &str| {
        report.error(
            spans,
            format!("{what} cannot be compiled by this version"),
            "leave it out",
        );
    };
    if let Definition::Lagrangian(root) = checked.definition {
        refuse(checked.node(root).spans, "`L(q; v) = …`");
    }
    if let Some((name, _)) = checked.split.first() {
        refuse(name.span().into(), "`split { … }`");
    }
    if let Some(root) = checked.force.first() {
        refuse(checked.node(*root).spans, "`force(q; p) = …`");
    }
    if let Some((_, span)) = checked.time_factor {
        refuse(span.into(), "`dt = g*ds`");
    }
    if let Some(chart) = checked.charts.first() {
        refuse(chart.name.span().into(), "`coordinates …`");
    }
}
