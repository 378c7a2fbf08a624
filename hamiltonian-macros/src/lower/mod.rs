//! Checked definition → model: names, types and vectors become scalar expressions of one arena.
//!
//! Input: [`Checked`]. Output: [`Lowered`]. Invariants: loops stay loops, but those that choose
//! components by number; nothing recurses, whatever the depth of the source; the order of the
//! source is the order of sums and products.
//!
//! A vector is never built: what is asked of it is its components. `demand` passes these wishes
//! from the roots down to the leaves, `evaluate` answers them from the leaves up.

mod bracket;
mod demand;
mod evaluate;
mod loops;
mod scope;

pub use scope::number;

use crate::ast;
use crate::checked::{Checked, Definition, NodeId, Type};
use crate::report::Report;
use demand::Demand;
use evaluate::Evaluator;
use hamiltonian_symbolic::dag::Node;
use hamiltonian_symbolic::index::Index;
use hamiltonian_symbolic::model::{
    External, Group, Model, Observable, ObservableKind, ParameterDeclaration,
};
use scope::{shape, size_affine};

/// Past this many nodes an expression is given up: its program would be past the cap many times
/// over.
const LARGEST: usize = 1 << 18;

/// The model of a definition, if it could be made; what is wrong goes into the report.
pub fn lower(checked: &Checked, report: &mut Report) -> Option<Model> {
    let mut model = declarations(checked);
    let mut evaluator = Evaluator::new(checked, report);
    let (Definition::Hamiltonian(h) | Definition::Lagrangian(h)) = checked.definition;
    let value = evaluator.evaluate(&mut model, &[(h, Demand::default())])?;
    model.hamiltonian = value.first().copied();
    observables(checked, &mut model, &mut evaluator)?;
    Some(model)
}

/// Names and shapes.
fn declarations(checked: &Checked) -> Model {
    let parameters = checked
        .parameters
        .iter()
        .map(|parameter| ParameterDeclaration {
            name: parameter.name.to_string(),
            shape: shape(parameter.ty),
        });
    let captures = checked.captures.iter().map(|name| ParameterDeclaration {
        name: name.to_string(),
        shape: shape(Type::Scalar),
    });
    Model {
        name: checked
            .item
            .as_ref()
            .map_or_else(|| "H".to_owned(), |item| item.name.to_string()),
        groups: checked
            .groups
            .iter()
            .map(|group| Group {
                coordinate: group.coordinate.to_string(),
                momentum: group.momentum.to_string(),
                shape: shape(group.ty),
            })
            .collect(),
        parameters: parameters.chain(captures).collect(),
        sizes: checked
            .sizes
            .iter()
            .map(|size| size.name.to_string())
            .collect(),
        time: checked.time.as_ref().map(ToString::to_string),
        externals: checked
            .functions
            .iter()
            .map(|function| External {
                name: function.name.to_string(),
                arity: function.arity as u16,
                second: function.second.is_some(),
            })
            .collect(),
        ..Model::default()
    }
}

/// The roots of a value: itself, or its components.
fn components(checked: &Checked, root: NodeId) -> Vec<(NodeId, Demand)> {
    match checked.node(root).ty {
        Type::Vector(extent) => {
            let length = size_affine(extent).as_constant().unwrap_or(0);
            (0..length)
                .map(|at| (root, Demand::at(Index::constant(at))))
                .collect()
        }
        _ => vec![(root, Demand::default())],
    }
}

fn observables(checked: &Checked, model: &mut Model, evaluator: &mut Evaluator) -> Option<()> {
    let roots: Vec<(NodeId, Demand)> = checked
        .observables
        .iter()
        .flat_map(|observable| components(checked, observable.value))
        .collect();
    let mut values: std::vec::IntoIter<Node> = evaluator.evaluate(model, &roots)?.into_iter();
    for observable in &checked.observables {
        let count = components(checked, observable.value).len();
        model.observables.push(Observable {
            name: observable.name.to_string(),
            kind: match observable.kind {
                ast::ObservableKind::Invariant => ObservableKind::Invariant,
                ast::ObservableKind::Monitor => ObservableKind::Monitor,
                ast::ObservableKind::Event => ObservableKind::Event,
            },
            components: values.by_ref().take(count).collect(),
        });
    }
    Some(())
}
