//! A system in new canonical coordinates.
//!
//! Input: a model whose H is written in the old coordinates, and charts. Output: [`Transformed`]:
//! the model in the new ones, K(Q, P, t) = H(q(Q), p(Q, P), t), and both maps as nodes. Invariant:
//! the new groups of a chart stand where its first old group stood.

use super::NoTransform;
use super::bodies::SizedBodies;
use super::charts::{self, Chart, Masses, NumberRange, PhaseNodes, Replaced};
use super::layout::{ChartVariables, GroupLayout, Placement, Slot, coordinate, placements};
use super::peel::peel;
use super::reduce::{self, Rules};
use crate::dag::{Array, Column, Dag, Dependence, Kind, Map, Node, Side};
use crate::diff;
use crate::index::{Affine, Index};
use crate::list::IntoList;
use crate::loops;
use crate::model::{Model, REPLACING, VectorEntry};
use crate::sort::Arrange;

/// A system in new coordinates, with the maps.
#[derive(Clone, Debug)]
pub struct Transformed {
    /// The system in the new coordinates. Its force acts on the new momenta.
    pub model: Model,
    /// The system as it was written; its arena holds the values of `forward`.
    pub source: Model,
    /// The new coordinates and momenta (of `model`) from the old ones (of `source`).
    pub forward: Vec<VectorEntry>,
    /// The old coordinates and momenta (of `source`) from the new ones (of `model`).
    pub inverse: Vec<VectorEntry>,
    /// Groups that no chart replaces: their numbers in `source` and in `model`.
    pub kept: Vec<(u16, u16)>,
    /// The places of the old variables in a state of the new shape: each element of
    /// phase space once. [`Transformed::forward_placed`] reads them there.
    pub places: Vec<Placement>,
    /// The new coordinates that take only some values inside their charts.
    pub(super) bounded: Vec<(Slot, NumberRange)>,
    bodies: Vec<SizedBodies>,
    rules: Rules,
}

/// The largest literal number of bodies that are written out one by one. Loops over more of them fill packs.
const WRITTEN_OUT: i64 = 8;

impl Transformed {
    /// The system in the coordinates of the charts, which replace different coordinates. Many bodies stay in loops, where
    /// each loop goes over all of them.
    ///
    /// # Errors
    /// [`NoTransform`]
    pub(super) fn new(model: &Model, charts: &[Chart]) -> Result<Transformed, NoTransform> {
        match Self::with_written_out(model, charts, WRITTEN_OUT) {
            Err(_) => Self::with_written_out(model, charts, i64::MAX),
            transformed => transformed,
        }
    }

    /// The same, with up to so many bodies written out one by one.
    fn with_written_out(
        model: &Model,
        charts: &[Chart],
        written_out: i64,
    ) -> Result<Transformed, NoTransform> {
        let mut layout = GroupLayout::new(model, charts)?;
        let mut source = model.clone();
        let bodies = bodies(&mut source, charts, &layout, written_out);
        for place in &mut layout.places {
            if bodies.iter().any(|of| of.new == place.first) {
                place.charted.clear();
            }
        }
        for of in &bodies {
            let force = std::mem::take(&mut source.force);
            let parts = force.iter().flat_map(|f| of.apart(&mut source.dag, f));
            source.force = parts.into_list();
        }
        let model = &source.clone();
        let (mut new, roots) = apart(model, &layout, &bodies)?;
        new.groups = layout.groups.clone();

        let mut rules = Rules::default();
        let mut forward = Vec::new();
        let mut inverse = Vec::new();
        let mut bounded = Vec::new();
        for (chart, place) in charts.iter().zip(&layout.places) {
            for variables in &place.charted {
                if let Replaced::Scalars(formulas, _) = chart.replaced() {
                    bounded.extend(
                        variables
                            .new
                            .iter()
                            .copied()
                            .zip(formulas.values.iter().copied()),
                    );
                }
                let old = variables.variables(&mut source.dag, true);
                let image = to_new(chart, model, &mut source.dag, &old);
                forward.extend(entries(&variables.new, &image));
                let fresh = variables.variables(&mut new.dag, false);
                let image = to_old(chart, model, &mut new.dag, &fresh, &mut rules);
                inverse.extend(entries(&variables.old, &image));
            }
            if let Chart::Jacobi(bodies) = chart {
                let masses = masses_of(model, &mut new.dag, bodies.masses);
                charts::jacobi_rules(&masses, &mut rules);
            }
        }

        let mut kept = layout.kept.clone();
        for (chart, place) in charts.iter().zip(&layout.places) {
            if let Chart::Jacobi(bodies) | Chart::Heliocentric(bodies) = chart {
                kept.push((REPLACING + bodies.group, place.first));
            }
        }
        let mut images = images(&mut new.dag, &roots, &inverse, &kept, &bodies).map_err(|old| {
            NoTransform::Wrapped {
                coordinate: coordinate(model, old),
            }
        })?;
        for (chart, place) in charts.iter().zip(&layout.places) {
            if let Replaced::Scalars(..) = chart.replaced() {
                images.extend(new_scalars(&mut new.dag, &place.charted));
            }
        }
        for of in &bodies {
            forward.extend(of.forward(&mut source.dag));
            inverse.extend(of.inverse(&mut new.dag));
        }
        let roots = reduce::substitute(&mut new.dag, &roots, &images, &rules);
        let roots = roots.ok_or(NoTransform::TooLong)?;
        new.set_roots(&roots);
        let mut places: Vec<Placement> = charts
            .iter()
            .zip(&layout.places)
            .flat_map(|(chart, place)| placements(model, chart, place.first))
            .into_list();
        places.extend(layout.kept.iter().map(|&(old, new)| Placement {
            old: (old, None),
            new,
        }));
        let force = std::mem::take(&mut new.force);
        let mut transformed = Transformed {
            model: new,
            source,
            forward,
            inverse,
            kept: layout.kept,
            places,
            bounded,
            bodies,
            rules,
        };
        if [&transformed.source, &transformed.model]
            .iter()
            .any(|model| model.dag.has_too_many_loops())
        {
            return Err(NoTransform::TooManyLoops);
        }
        transformed.force(force);
        Ok(transformed)
    }

    /// The place of an element of the old variables among the new ones.
    fn place(&self, at: Column, row: &Index) -> (Column, Index) {
        let number = row.affine.as_constant().map(|row| row as u32);
        for place in &self.places {
            let to = Column {
                group: place.new,
                ..at
            };
            match place.old {
                (old, None) if old == at.group => return (to, row.clone()),
                (old, Some(own)) if old == at.group && number == Some(own) => {
                    return (to, Index::constant(0));
                }
                _ => {}
            }
        }
        (at, row.clone())
    }

    /// The map to the new coordinates, in the arena of `model`: the old ones are read where
    /// `places` says they stand.
    pub fn forward_placed(&mut self) -> Vec<VectorEntry> {
        let mut images: Map<Node, Node> = Map::default();
        let values: Vec<Node> = self.forward.iter().map(|entry| entry.value).into_list();
        for node in self.source.dag.reachable(&values) {
            let image = match self.source.dag.kind(node) {
                Kind::Element(Array::Phase(column), row, _) => {
                    let (column, row) = self.place(*column, row);
                    self.model.dag.phase(column, row)
                }
                kind => {
                    let kind = kind.clone();
                    self.model.dag.construct(kind, &|child| images[&child])
                }
            };
            images.insert(node, image);
        }
        let with_image = |entry: &VectorEntry| VectorEntry {
            value: images[&entry.value],
            ..entry.clone()
        };
        self.forward.iter().map(with_image).into_list()
    }

    /// The map to the old coordinates, written where `places` says they stand.
    #[must_use]
    pub fn inverse_placed(&self) -> Vec<VectorEntry> {
        let moved = |entry: &VectorEntry| {
            let (at, row) = self.place(entry.at, &entry.row);
            let value = entry.value;
            VectorEntry { at, row, value }
        };
        self.inverse.iter().map(moved).into_list()
    }

    /// A force on the old momenta, ṗ += f, becomes one on the new ones, Ṗ += (∂q/∂Q)ᵀ f, because
    /// P = (∂q/∂Q)ᵀ p. The values of `force` are in the new coordinates; each names the old momentum
    /// it acts on.
    fn force(&mut self, force: Vec<VectorEntry>) {
        let mut unchanged: Vec<VectorEntry> = Vec::new();
        let mut found: Vec<VectorEntry> = Vec::new();
        let dag = &mut self.model.dag;
        for mut entry in force {
            if let Some((_, group)) = self.kept.iter().find(|(old, _)| *old == entry.at.group) {
                entry.at.group = *group;
                unchanged.push(entry);
                continue;
            }
            if let Some(bodies) = self.bodies.iter().find(|b| b.old == entry.at.group) {
                bodies.force(dag, &entry, &mut found);
                continue;
            }
            let of_q = (entry.at.on(Side::Q), &entry.row);
            let old = self.inverse.iter().find(|e| (e.at, &e.row) == of_q);
            let Some(old) = old else { continue };
            for (leaf, slope) in diff::gradient(dag, old.value, Dependence::Q) {
                let Some((column, row)) = dag.phase_place(leaf) else {
                    continue;
                };
                let (at, row) = (column.on(Side::P), row.clone());
                let value = dag.mul(&[slope, entry.value]);
                match found.iter_mut().find(|e| (e.at, &e.row) == (at, &row)) {
                    Some(sum) => sum.value = dag.add(&[sum.value, value]),
                    None => found.push(VectorEntry { at, row, value }),
                }
            }
        }
        for entry in &mut found {
            entry.value = reduce::reduce(dag, entry.value, &self.rules);
        }
        found.arrange_by_key(|e| (e.at, e.row.clone()));
        unchanged.extend(found);
        self.model.force = unchanged;
    }
}

fn masses_of(model: &Model, dag: &mut Dag, parameter: crate::dag::Parameter) -> Masses {
    let shape = &model.parameters[usize::from(parameter.0)].shape;
    // Jacobi's are for a literal number of bodies ([`NoTransform::Number`]).
    let rows = shape.rows().and_then(Affine::as_constant);
    let each = (0..rows.into_iter().sum())
        .map(|row| dag.element(Array::Parameter(parameter), Index::constant(row), None))
        .into_list();
    Masses::new(dag, each)
}

fn to_new(chart: &Chart, model: &Model, dag: &mut Dag, old: &PhaseNodes) -> PhaseNodes {
    match (chart.replaced(), chart) {
        (Replaced::Scalars(formulas, _), _) => formulas.to_new(dag, old),
        (Replaced::Bodies(bodies), Chart::Jacobi(_)) => {
            let masses = masses_of(model, dag, bodies.masses);
            charts::jacobi_to_new(dag, old, &masses)
        }
        (Replaced::Bodies(_), _) => charts::heliocentric_to_new(dag, old),
    }
}

fn to_old(
    chart: &Chart,
    model: &Model,
    dag: &mut Dag,
    new: &PhaseNodes,
    rules: &mut Rules,
) -> PhaseNodes {
    match (chart.replaced(), chart) {
        (Replaced::Scalars(formulas, _), _) => formulas.to_old(dag, new, rules),
        (Replaced::Bodies(bodies), Chart::Jacobi(_)) => {
            let masses = masses_of(model, dag, bodies.masses);
            charts::jacobi_to_old(dag, new, &masses)
        }
        (Replaced::Bodies(_), _) => charts::heliocentric_to_old(dag, new),
    }
}

fn entries<'a>(
    slots: &'a [Slot],
    values: &'a PhaseNodes,
) -> impl Iterator<Item = VectorEntry> + 'a {
    [(Side::Q, &values.q), (Side::P, &values.p)]
        .into_iter()
        .flat_map(move |(side, values)| {
            slots
                .iter()
                .zip(values)
                .map(move |(slot, value)| VectorEntry {
                    at: slot.at(side),
                    row: Index::constant(i64::from(slot.row)),
                    value: *value,
                })
        })
}

/// The scalars of a chart as a declared split reads them, each in the place of an old one, with those of the new model.
fn new_scalars(dag: &mut Dag, charted: &[ChartVariables]) -> Vec<(Node, Node)> {
    let mut found = Vec::new();
    for variables in charted {
        for (old, new) in variables.old.iter().zip(&variables.new) {
            let group = REPLACING + old.group;
            for side in [Side::Q, Side::P] {
                let read = Slot { group, ..*old }.node(dag, side);
                found.push((read, new.node(dag, side)));
            }
        }
    }
    found
}

/// The groups of bodies that are mapped in loops.
fn bodies(
    model: &mut Model,
    charts: &[Chart],
    layout: &GroupLayout,
    written_out: i64,
) -> Vec<SizedBodies> {
    let places = charts.iter().zip(&layout.places);
    places
        .filter_map(|(chart, place)| match chart {
            Chart::Heliocentric(bodies) => {
                SizedBodies::new(model, (bodies.group, place.first), written_out)
            }
            _ => None,
        })
        .into_list()
}

/// The model whose arena the new system is built in, with all its expressions, unrolled where a loop
/// reads a replaced coordinate.
fn apart(
    model: &Model,
    layout: &GroupLayout,
    bodies: &[SizedBodies],
) -> Result<(Model, Vec<Node>), NoTransform> {
    let roots = model.roots();
    let is_looped = |group: &u16| !bodies.iter().any(|b| b.old == *group);
    let written: Vec<u16> = layout
        .replaced
        .iter()
        .copied()
        .filter(is_looped)
        .into_list();
    if model.sizes.is_empty() && bodies.is_empty() {
        let looped =
            model
                .dag
                .reachable(&roots)
                .into_iter()
                .find_map(|node| match model.dag.kind(node) {
                    Kind::Element(Array::Phase(Column { group, .. }), row, _)
                        if written.contains(group) && row.as_constant().is_none() =>
                    {
                        Some(*group)
                    }
                    _ => None,
                });
        let Some(group) = looped else {
            return Ok((model.clone(), roots));
        };
        let refused = |reason: String| NoTransform::Loops {
            coordinate: coordinate(model, group),
            reason,
        };
        return loops::unroll_nodes(model, &[], &roots).map_err(refused);
    }
    let mut peeled = model.clone();
    let roots = peel(&mut peeled, &roots, &written, bodies)?;
    Ok((peeled, roots))
}

/// The image of each element that is read: by the map of its chart, by that of its bodies, or at the
/// number of its group in the new model. The group of bodies is the error where an index wraps around.
fn images(
    dag: &mut Dag,
    roots: &[Node],
    inverse: &[VectorEntry],
    kept: &[(u16, u16)],
    bodies: &[SizedBodies],
) -> Result<Map<Node, Node>, u16> {
    let mut images: Map<Node, Node> = Map::default();
    for entry in inverse {
        let old = dag.phase(entry.at, entry.row.clone());
        images.insert(old, entry.value);
    }
    for node in dag.reachable(roots) {
        let Some((column, row)) = dag.phase_place(node) else {
            continue;
        };
        let row = row.clone();
        let of = bodies.iter().find(|of| of.old == column.group);
        let to = kept.iter().find(|(old, _)| *old == column.group);
        let image = match (of, to) {
            (Some(of), _) => {
                let image = of.image(dag, bodies, (column.side, column.column), &row);
                image.ok_or(of.old)?
            }
            (None, Some(&(_, group))) => dag.phase(Column { group, ..column }, row),
            (None, None) => continue,
        };
        images.insert(node, image);
    }
    Ok(images)
}
