//! Checked definition → model: names, types and vectors become scalar expressions of one arena.
//!
//! Input: [`Checked`]. Output: [`Lowered`]. Invariants: loops stay loops, except those that choose
//! components by number; nothing recurses, at any depth of the source; sums and products keep the
//! order of the source.
//!
//! A vector is never built; parents demand components of it. `demand` passes these demands from the
//! roots down to the leaves, `evaluate` answers them from the leaves up.
//!
//! Check and lower are two passes, because what is not demanded is not evaluated: `[1/0, x][1]` is a
//! formula. One forward pass would meet `1/0` first. Only after a loop's body is it known whether the
//! loop is unrolled. A fault of the number put in is reported at its tokens; nodes of the arena have none.

mod demand;
mod domain;
pub mod ends;
mod evaluate;
mod loops;
mod scope;
mod velocity;

use crate::check::SHARE_LOOPS;
use crate::checked::{Checked, Definition, NodeId, Type};
use crate::report::Report;
use demand::Demand;
use evaluate::{Derived, Evaluator};
use hamiltonian_symbolic::dag::{Column, Dag, Dependence, Node, Side};
use hamiltonian_symbolic::index::{Affine, Index, LOOPS};
use hamiltonian_symbolic::legendre::{Legendre, NoHamiltonian};
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::model::{
    External, Group, Model, Observable, ParameterDeclaration, Shape, VectorEntry, VectorFunction,
    VectorUse,
};
use hamiltonian_symbolic::overflow::OutOfRange;
use proc_macro2::Span;
use scope::{group_shape, shape};

/// The number of nodes at which an expression is refused: its program would exceed the cap many
/// times over.
const LARGEST: usize = 1 << 18;

/// Expressions with their coefficients.
pub type Beyond = Vec<(OutOfRange, NodeId)>;

/// A definition as mathematics.
#[derive(Debug)]
pub struct Lowered {
    /// H with names, shapes and observables; p(q, v) and v(q, p) of a Lagrangian as its first two
    /// vector functions.
    pub model: Model,
    /// The shell of each observable, where one is declared.
    pub shells: Vec<Option<Node>>,
    /// The components of the observables before velocities became functions of momenta.
    pub in_velocities: Vec<Node>,
    /// The Legendre transform that made H of a Lagrangian.
    pub legendre: Option<Legendre>,
    /// The expressions outside the range of `f64`, or with a coefficient outside it, innermost
    /// first.
    pub beyond: Beyond,
    /// The expressions that were derived.
    derived: Derived,
}

/// Lowers a definition, unless there are errors; these are in the report.
pub fn lower(checked: &Checked, report: &mut Report) -> Option<Lowered> {
    let Some(mut model) = declarations(checked) else {
        report.internal(
            Span::call_site(),
            "the columns of a group are not a literal",
        );
        return None;
    };
    let mut evaluator = Evaluator::new(checked, report);
    let (Definition::Hamiltonian(h) | Definition::Lagrangian(h)) = checked.definition;
    let value = evaluator.evaluate(&mut model, &whole([h]))?;
    model.hamiltonian = Some(value[0]);
    let before = model.dag.len();
    let in_momenta = match checked.definition {
        Definition::Hamiltonian(_) => value[0],
        Definition::Lagrangian(_) => velocity::as_momenta(&mut model.dag, value[0]),
    };
    if !model.dag.dependence(in_momenta).on(Dependence::P) {
        evaluator.refuse_motionless(h);
        return None;
    }
    let mut made = None;
    if let Definition::Lagrangian(root) = checked.definition {
        match legendre(&mut model, in_momenta) {
            Ok(legendre) => {
                evaluator.derived.since(before, &model);
                evaluator.velocities = Some(legendre.velocities.clone());
                made = Some(legendre);
            }
            Err(refusal) => {
                evaluator.refuse(
                    checked.node(root).spans,
                    &format!("this Lagrangian has no Hamiltonian: {}", refusal.reason),
                    refusal.help,
                );
                return None;
            }
        }
    }
    let observables: Vec<_> = checked
        .observables
        .iter()
        .flat_map(|o| components(checked, o.value))
        .into_list();
    let in_velocities = evaluator.evaluate(&mut model, &observables)?;
    let values = evaluator.all_in_momenta(&mut model, &observables, &in_velocities)?;
    observables_of(checked, &mut model, values);
    let mut shells = Vec::new();
    for observable in &checked.observables {
        let shell = evaluator.values(&mut model, &whole(observable.shell))?;
        shells.push(shell.first().copied());
    }
    let pieces = checked.split.iter().map(|(_, piece)| *piece);
    model.split = evaluator.values(&mut model, &whole(pieces))?;
    let factor = whole(checked.time_factor.map(|(g, _)| g));
    model.factor = evaluator.values(&mut model, &factor)?.first().copied();
    model.force = evaluator.force(&mut model)?;
    // Proofs and derivatives after this point would contain other loops.
    if model.dag.has_too_many_loops() {
        let message = format!("this system needs more than {LOOPS} loops");
        let at = checked.node(h).spans;
        evaluator.refuse(at, &message, SHARE_LOOPS);
        return None;
    }
    let Evaluator {
        derived, beyond, ..
    } = evaluator;
    Some(Lowered {
        beyond,
        model,
        shells,
        in_velocities,
        legendre: made,
        derived,
    })
}

/// Expressions of numbers alone, in an arena of their own.
pub fn constants(
    checked: &Checked,
    roots: &[NodeId],
    report: &mut Report,
) -> Option<(Dag, Vec<Node>)> {
    let mut model = Model::default();
    let values =
        Evaluator::new(checked, report).evaluate(&mut model, &whole(roots.iter().copied()))?;
    Some((model.dag, values))
}

/// Replaces L, which has momenta in the place of velocities, by H; p(q, v) and v(q, p) become
/// vector functions.
fn legendre(model: &mut Model, lagrangian: Node) -> Result<Legendre, NoHamiltonian> {
    let legendre = hamiltonian_symbolic::legendre::transform(model, lagrangian)?;
    model.hamiltonian = Some(legendre.hamiltonian);
    for (usage, components, side) in [
        (VectorUse::ConjugateMomentum, &legendre.momenta, Side::P),
        (VectorUse::Velocity, &legendre.velocities, Side::Q),
    ] {
        let entries = velocity::entries(&model.dag, components, side);
        model.vectors.push(VectorFunction { usage, entries });
    }
    Ok(legendre)
}

/// Expressions without indices as roots.
fn whole(roots: impl IntoIterator<Item = NodeId>) -> Vec<(NodeId, Demand)> {
    roots
        .into_iter()
        .map(|root| (root, Demand::default()))
        .into_list()
}

impl Evaluator<'_> {
    /// Refuses a definition that depends on no momentum or no velocity, also if these cancel.
    fn refuse_motionless(&mut self, root: NodeId) {
        let (word, of, example) = match self.checked.definition {
            Definition::Hamiltonian(_) => ("H", "momentum", "p^2/2"),
            Definition::Lagrangian(_) => ("L", "velocity", "v^2/2"),
        };
        let help = match self.checked.captures.first() {
            Some(capture) if word == "H" => format!(
                "`{capture}` is captured from the surrounding scope; name the momenta in the signature: \
                 `H(x; p_x) = …`"
            ),
            _ => format!("nothing would move: write a kinetic energy, such as `{example}`"),
        };
        let message = format!("`{word}` depends on no {of}");
        self.refuse(self.checked.node(root).spans, &message, &help);
    }

    /// The values of roots, velocities as functions of (q, p, t).
    fn values(&mut self, model: &mut Model, roots: &[(NodeId, Demand)]) -> Option<Vec<Node>> {
        let values = self.evaluate(model, roots)?;
        self.all_in_momenta(model, roots, &values)
    }

    fn all_in_momenta(
        &mut self,
        model: &mut Model,
        roots: &[(NodeId, Demand)],
        values: &[Node],
    ) -> Option<Vec<Node>> {
        let mut images = Vec::with_capacity(values.len());
        for ((root, _), value) in roots.iter().zip(values) {
            let spans = self.checked.node(*root).spans;
            images.push(self.in_momenta(model, spans, *value)?);
        }
        Some(images)
    }

    /// The force on each momentum, element by element.
    fn force(&mut self, model: &mut Model) -> Option<Vec<VectorEntry>> {
        let mut entries = Vec::new();
        for (group, root) in self.checked.force.iter().enumerate() {
            let shape = model.groups[group].shape.clone();
            let (rows, columns) = (shape.rows().cloned(), shape.columns());
            // A force is transformed element by element to other coordinates, and the components of
            // some vectors can be chosen by number only.
            let at_rows = &self.checked.force_rows[..];
            let by_number = !self.checked.charts.is_empty()
                || match at_rows.first() {
                    Some(id) => self.demands.loops.is_unrolled(*id),
                    None => {
                        matches!(shape, Shape::Vector(_) | Shape::Lattice(..))
                            && self.demands.loops.by_number(*root)
                    }
                };
            let places: Vec<Index> = match rows {
                None => vec![Index::constant(0)],
                Some(rows) => match rows.as_constant().filter(|_| by_number) {
                    Some(count) => (0..count).map(Index::constant).into_list(),
                    None => {
                        let domain = model.dag.domain(None, Affine::constant(0), rows);
                        vec![Index::of_loop(domain)]
                    }
                },
            };
            let axes = shape.axes();
            let places = if axes.is_empty() {
                places
            } else {
                sites(&mut model.dag, axes)
            };
            for (row, column) in places
                .iter()
                .flat_map(|row| (0..columns).map(move |column| (row, column)))
            {
                let mut demand = Demand::default();
                match (at_rows, row.affine.as_constant()) {
                    ([id, ..], Some(number)) => demand.values.push((*id, number)),
                    ([_, ..], None) => {
                        let inner = row.axes().into_iter().skip(at_rows.len());
                        demand.indices.extend(inner);
                    }
                    ([], _) if shape == Shape::Scalar => {}
                    ([], _) => demand.indices.extend(row.axes()),
                }
                if matches!(shape, Shape::Matrix(..)) {
                    let column = i64::from(column);
                    match at_rows {
                        [_, id] => demand.values.push((*id, column)),
                        _ => demand.indices.push(Index::constant(column)),
                    }
                }
                let value = self.values(model, &[(*root, demand)])?[0];
                let at = Column {
                    side: Side::P,
                    group: group as u16,
                    column,
                };
                let row = row.clone();
                entries.push(VectorEntry { at, row, value });
            }
        }
        Some(entries)
    }
}

/// The index of each site of a lattice, in loops over its axes.
fn sites(dag: &mut Dag, axes: &[Affine]) -> Vec<Index> {
    let mut parent = None;
    let site = axes.iter().fold(None, |row: Option<Index>, extent| {
        let domain = dag.domain(parent, Affine::constant(0), extent.clone());
        parent = Some(domain);
        let index = Index::of_loop(domain);
        Some(match row {
            Some(row) => row.row_of(extent.clone(), index),
            None => index,
        })
    });
    site.into_iter().into_list()
}

/// Names and shapes.
fn declarations(checked: &Checked) -> Option<Model> {
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
    let group = |group: &crate::checked::Group| {
        Some(Group {
            coordinate: group.coordinate.to_string(),
            momentum: group.momentum.to_string(),
            velocity: group.velocity.as_ref().map(ToString::to_string),
            shape: group_shape(group)?,
        })
    };
    Some(Model {
        name: checked
            .item
            .as_ref()
            .map_or_else(|| "H".to_owned(), |item| item.name.to_string()),
        groups: checked.groups.iter().map(group).collect::<Option<_>>()?,
        parameters: parameters.chain(captures).into_list(),
        sizes: checked
            .sizes
            .iter()
            .map(|size| size.name.to_string())
            .into_list(),
        time: checked.time.as_ref().map(ToString::to_string),
        externals: checked
            .functions
            .iter()
            .map(|function| External {
                name: function.name.to_string(),
                arguments: function
                    .arguments
                    .iter()
                    .map(ToString::to_string)
                    .into_list(),
            })
            .into_list(),
        ..Model::default()
    })
}

/// The roots of a value: itself, or its components.
fn components(checked: &Checked, root: NodeId) -> Vec<(NodeId, Demand)> {
    match checked.node(root).ty {
        Type::Vector(extent) => {
            let length = extent.affine().as_constant();
            let length = length.expect("an observable has a literal number of components");
            (0..length)
                .map(|at| (root, Demand::at(Index::constant(at))))
                .into_list()
        }
        _ => vec![(root, Demand::default())],
    }
}

/// The observables of the model, from the values of their components.
fn observables_of(checked: &Checked, model: &mut Model, values: Vec<Node>) {
    let mut values = values.into_iter();
    for observable in &checked.observables {
        let count = components(checked, observable.value).len();
        model.observables.push(Observable {
            name: observable.name.to_string(),
            kind: observable.kind,
            components: values.by_ref().take(count).into_list(),
        });
    }
}
