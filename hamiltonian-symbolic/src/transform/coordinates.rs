//! A system in new canonical coordinates.
//!
//! Input: a model whose H is written in the old coordinates, and charts. Output: [`Transformed`]:
//! the model in the new ones, K(Q, P, t) = H(q(Q), p(Q, P), t), and both maps as nodes. Invariant:
//! K agrees with H at sample points of the chart ([`check`], which [`apply`] ends with); the new
//! groups of a chart stand where its first old group stood.

use super::charts::{self, Chart, Component, Masses, Variables};
use super::reduce::{self, Rules};
use super::verify::check;
use super::{Refusal, element, is_taken};
use crate::dag::{Array, Dag, Dependence, Kind, Map, Node, Side};
use crate::diff;
use crate::index::{Affine, Index};
use crate::loops;
use crate::model::{Group, Model, Shape, VectorEntry};

/// A system in new coordinates, with the maps.
#[derive(Clone, Debug)]
pub struct Transformed {
    /// The system in the new coordinates: its H and observables.
    pub model: Model,
    /// What was carried along, in the new coordinates.
    pub carried: Vec<Node>,
    /// The system as it was written; its arena holds the values of `forward`.
    pub source: Model,
    /// The new coordinates and momenta (of `model`) from the old ones (of `source`).
    pub forward: Vec<VectorEntry>,
    /// The old coordinates and momenta (of `source`) from the new ones (of `model`).
    pub inverse: Vec<VectorEntry>,
    /// Groups that no chart replaces: their numbers in `source` and in `model`.
    pub kept: Vec<(u16, u16)>,
    /// Where the old variables stand when a state of the new shape holds them: each element of
    /// phase space once. [`Transformed::forward_standing`] reads them there.
    pub places: Vec<Standing>,
    rules: Rules,
}

/// A group, or one row of it, among the old variables, and where it stands among the new ones.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Standing {
    /// The group of the source, and the row of a vector that becomes scalars.
    pub old: (u16, Option<u32>),
    /// The group of the model, which has as many elements.
    pub new: u16,
}

/// A scalar place of phase space.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) struct Slot {
    pub(super) group: u16,
    pub(super) row: u32,
    pub(super) column: u16,
}

/// The system in the coordinates of the charts, which replace different coordinates; `carried` are
/// further functions of (q, p, t) to be written in the new ones.
///
/// Loops that read a replaced coordinate are written out, so their lengths must be literal.
///
/// # Errors
/// [`Refusal`].
pub fn apply(model: &Model, charts: &[Chart], carried: &[Node]) -> Result<Transformed, Refusal> {
    let layout = Layout::new(model, charts)?;
    let mut source = model.clone();
    let (mut new, roots) = written_out(model, &layout, carried)?;
    new.groups = layout.groups.clone();

    let mut rules = Rules::default();
    let mut forward = Vec::new();
    let mut inverse = Vec::new();
    for (chart, place) in charts.iter().zip(&layout.places) {
        for block in &place.blocks {
            let old = block.variables(&mut source.dag, true);
            let image = to_new(chart, model, &mut source.dag, &old);
            forward.extend(entries(&block.new, &image));
            let fresh = block.variables(&mut new.dag, false);
            let image = to_old(chart, model, &mut new.dag, &fresh, &mut rules);
            inverse.extend(entries(&block.old, &image));
        }
        if let Chart::Jacobi(bodies) = chart {
            let masses = masses_of(model, &mut new.dag, bodies.masses);
            charts::jacobi_rules(&masses, &mut rules);
        }
    }

    let images = images(&mut new.dag, &roots, &inverse, &layout.kept);
    let roots = reduce::substitute(&mut new.dag, &roots, &images, &rules);
    let carried = distribute(&mut new, roots);
    let mut places: Vec<Standing> = charts
        .iter()
        .zip(&layout.places)
        .flat_map(|(chart, place)| standing(model, chart, place.first))
        .collect();
    places.extend(layout.kept.iter().map(|&(old, new)| Standing {
        old: (old, None),
        new,
    }));
    let transformed = Transformed {
        model: new,
        carried,
        source,
        forward,
        inverse,
        kept: layout.kept,
        places,
        rules,
    };
    check(&transformed)?;
    Ok(transformed)
}

impl Transformed {
    /// Where an element of the old variables stands among the new ones.
    fn place(&self, group: u16, row: &Index) -> (u16, Index) {
        let at = row.affine.as_constant().map(|row| row as u32);
        for place in &self.places {
            match place.old {
                (old, None) if old == group => return (place.new, row.clone()),
                (old, Some(own)) if old == group && at == Some(own) => {
                    return (place.new, Index::constant(0));
                }
                _ => {}
            }
        }
        (group, row.clone())
    }

    /// The map to the new coordinates, in the arena of `model`: the old ones are read where
    /// `places` says they stand.
    pub fn forward_standing(&mut self) -> Vec<VectorEntry> {
        let mut images: Map<Node, Node> = Map::default();
        let values: Vec<Node> = self.forward.iter().map(|entry| entry.value).collect();
        for node in self.source.dag.reachable(&values) {
            let image = match self.source.dag.kind(node) {
                Kind::Element(
                    Array::Phase {
                        side,
                        group,
                        column,
                    },
                    row,
                    _,
                ) => {
                    let (group, row) = self.place(*group, row);
                    let array = Array::Phase {
                        side: *side,
                        group,
                        column: *column,
                    };
                    self.model.dag.element(array, row, None)
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
        self.forward.iter().map(with_image).collect()
    }

    /// The map to the old coordinates, written where `places` says they stand.
    #[must_use]
    pub fn inverse_standing(&self) -> Vec<VectorEntry> {
        let moved = |entry: &VectorEntry| {
            let (group, row) = self.place(entry.group, &entry.row);
            VectorEntry {
                group,
                row,
                ..entry.clone()
            }
        };
        self.inverse.iter().map(moved).collect()
    }

    /// A force on the old momenta, ṗ += f, as one on the new ones, Ṗ += (∂q/∂Q)ᵀ f, because
    /// P = (∂q/∂Q)ᵀ p. The values of `force` are in the new coordinates (from `carried`); each
    /// names the old momentum it acts on. Groups that are kept keep theirs and are not named here.
    pub fn force(&mut self, force: &[VectorEntry]) -> Vec<VectorEntry> {
        let mut found: Vec<VectorEntry> = Vec::new();
        let dag = &mut self.model.dag;
        for entry in force {
            let old = self.inverse.iter().find(|e| {
                e.side == Side::Q
                    && (e.group, &e.row, e.column) == (entry.group, &entry.row, entry.column)
            });
            let Some(old) = old else { continue };
            for (leaf, slope) in diff::gradient(dag, old.value, Dependence::Q) {
                let Kind::Element(Array::Phase { group, column, .. }, row, _) = dag.kind(leaf)
                else {
                    continue;
                };
                let (group, row, column) = (*group, row.clone(), *column);
                let part = dag.mul(&[slope, entry.value]);
                match found
                    .iter_mut()
                    .find(|e| (e.group, &e.row, e.column) == (group, &row, column))
                {
                    Some(sum) => sum.value = dag.add(&[sum.value, part]),
                    None => found.push(VectorEntry {
                        side: Side::P,
                        group,
                        row,
                        column,
                        value: part,
                    }),
                }
            }
        }
        for entry in &mut found {
            entry.value = reduce::reduce(dag, entry.value, &self.rules);
        }
        found.sort_by_key(|e| (e.group, e.column, e.row.clone()));
        found
    }
}

/// One set of variables that a chart maps as a whole: bodies are mapped component by component.
struct Block {
    old: Vec<Slot>,
    new: Vec<Slot>,
}

impl Block {
    fn variables(&self, dag: &mut Dag, old: bool) -> Variables {
        let mut variables = Variables::default();
        for slot in if old { &self.old } else { &self.new } {
            let mut read = |side| element(dag, side, slot.group, slot.row, slot.column);
            variables.q.push(read(Side::Q));
            variables.p.push(read(Side::P));
        }
        variables
    }
}

struct Place {
    blocks: Vec<Block>,
    /// The first new group.
    first: u16,
}

/// The groups of the new model.
struct Layout {
    groups: Vec<Group>,
    places: Vec<Place>,
    kept: Vec<(u16, u16)>,
    replaced: Vec<u16>,
}

impl Layout {
    fn new(model: &Model, charts: &[Chart]) -> Result<Layout, Refusal> {
        let mut replaced: Vec<u16> = Vec::new();
        for chart in charts {
            let own = replaced_groups(model, chart)?;
            for group in &own {
                if replaced.contains(group) {
                    return Err(Refusal::NotWhole {
                        coordinate: coordinate(model, *group),
                    });
                }
            }
            replaced.extend(own);
        }
        let mut groups: Vec<Group> = Vec::new();
        let mut kept = Vec::new();
        let mut firsts: Vec<Option<u16>> = vec![None; charts.len()];
        for (number, group) in model.groups.iter().enumerate() {
            let number = number as u16;
            if !replaced.contains(&number) {
                kept.push((number, groups.len() as u16));
                groups.push(group.clone());
                continue;
            }
            for (chart, first) in charts.iter().zip(&mut firsts) {
                if first.is_none() && members(chart).contains(&number) {
                    *first = Some(groups.len() as u16);
                    groups.extend(new_groups(model, chart));
                }
            }
        }
        // Old names go, so they may come back: what is left must not meet what is new.
        let mut left = model.clone_names();
        left.groups = kept
            .iter()
            .map(|(old, _)| model.groups[usize::from(*old)].clone())
            .collect();
        for chart in charts {
            for group in new_groups(model, chart) {
                for name in [&group.coordinate, &group.momentum] {
                    if is_taken(&left, name) {
                        return Err(Refusal::NameTaken {
                            name: name.clone(),
                            by: chart.word(),
                        });
                    }
                }
                left.groups.push(group);
            }
        }
        let places = charts
            .iter()
            .zip(firsts)
            .map(|(chart, first)| {
                let first = first.unwrap_or(0);
                let blocks = blocks(model, chart, first);
                Place { blocks, first }
            })
            .collect();
        Ok(Layout {
            groups,
            places,
            kept,
            replaced,
        })
    }
}

impl Model {
    /// The declarations without the mathematics.
    fn clone_names(&self) -> Model {
        Model {
            name: self.name.clone(),
            groups: self.groups.clone(),
            parameters: self.parameters.clone(),
            sizes: self.sizes.clone(),
            time: self.time.clone(),
            externals: self.externals.clone(),
            observables: self.observables.clone(),
            ..Model::default()
        }
    }
}

fn coordinate(model: &Model, group: u16) -> String {
    model
        .groups
        .get(usize::from(group))
        .map_or_else(|| format!("coordinate {group}"), |g| g.coordinate.clone())
}

/// The groups a chart names, each once.
fn members(chart: &Chart) -> Vec<u16> {
    let components: &[Component] = match chart {
        Chart::Polar(components) => components,
        Chart::Spherical(components) => components,
        Chart::Jacobi(bodies) | Chart::Heliocentric(bodies) => return vec![bodies.group],
    };
    let mut groups: Vec<u16> = components.iter().map(|c| c.group).collect();
    groups.sort_unstable();
    groups.dedup();
    groups
}

/// The groups a chart replaces, which it must replace as a whole.
fn replaced_groups(model: &Model, chart: &Chart) -> Result<Vec<u16>, Refusal> {
    let groups = members(chart);
    for &group in &groups {
        let refused = |wanted| Refusal::Shape {
            coordinate: coordinate(model, group),
            wanted,
        };
        let Some(shape) = model.groups.get(usize::from(group)).map(|g| &g.shape) else {
            return Err(refused("declared"));
        };
        let components: &[Component] = match chart {
            Chart::Polar(components) => components,
            Chart::Spherical(components) => components,
            Chart::Jacobi(bodies) | Chart::Heliocentric(bodies) => {
                let (rows, _) =
                    extents(shape).ok_or(refused("an array of a literal number of bodies"))?;
                let masses = model.parameters.get(usize::from(bodies.masses.0));
                if *shape == Shape::Scalar
                    || rows < 1
                    || masses.map(|m| &m.shape) != Some(&Shape::Vector(Affine::constant(rows)))
                {
                    return Err(refused("an array of as many bodies as there are masses"));
                }
                continue;
            }
        };
        let count = match extents(shape) {
            Some((rows, 1)) => rows,
            _ => return Err(refused("a number or a vector of literal length")),
        };
        let mut rows: Vec<i64> = components
            .iter()
            .filter(|c| c.group == group)
            .map(|c| i64::from(c.row.unwrap_or(0)))
            .collect();
        rows.sort_unstable();
        if !rows.iter().copied().eq(0..count) {
            return Err(Refusal::NotWhole {
                coordinate: coordinate(model, group),
            });
        }
    }
    Ok(groups)
}

/// Rows and columns, where both are literal.
fn extents(shape: &Shape) -> Option<(i64, i64)> {
    match shape {
        Shape::Scalar => Some((1, 1)),
        Shape::Vector(rows) => Some((rows.as_constant()?, 1)),
        Shape::Matrix(rows, columns) => Some((rows.as_constant()?, columns.as_constant()?)),
    }
}

fn new_groups(model: &Model, chart: &Chart) -> Vec<Group> {
    let scalar = |name: &&str| Group {
        coordinate: (*name).to_owned(),
        momentum: format!("p_{name}"),
        shape: Shape::Scalar,
    };
    let bodies = |group: u16| {
        let old = &model.groups[usize::from(group)];
        vec![Group {
            coordinate: format!("{}_{}", old.coordinate, chart.word()),
            momentum: format!("{}_{}", old.momentum, chart.word()),
            shape: old.shape.clone(),
        }]
    };
    match chart {
        Chart::Polar(_) => ["r", "phi"].iter().map(scalar).collect(),
        Chart::Spherical(_) => ["r", "theta", "phi"].iter().map(scalar).collect(),
        Chart::Jacobi(b) | Chart::Heliocentric(b) => bodies(b.group),
    }
}

/// The sets of variables of a chart whose first new group has the given number.
fn blocks(model: &Model, chart: &Chart, first: u16) -> Vec<Block> {
    let scalars = |components: &[Component]| {
        let old = components.iter().map(|c| Slot {
            group: c.group,
            row: c.row.unwrap_or(0),
            column: 0,
        });
        let new = (0..components.len() as u16).map(|at| Slot {
            group: first + at,
            row: 0,
            column: 0,
        });
        vec![Block {
            old: old.collect(),
            new: new.collect(),
        }]
    };
    match chart {
        Chart::Polar(components) => scalars(components),
        Chart::Spherical(components) => scalars(components),
        Chart::Jacobi(bodies) | Chart::Heliocentric(bodies) => {
            let shape = &model.groups[usize::from(bodies.group)].shape;
            let (rows, columns) = extents(shape).unwrap_or((0, 0));
            let column = |group: u16, column: i64| -> Vec<Slot> {
                (0..rows)
                    .map(|row| Slot {
                        group,
                        row: row as u32,
                        column: column as u16,
                    })
                    .collect()
            };
            (0..columns)
                .map(|at| Block {
                    old: column(bodies.group, at),
                    new: column(first, at),
                })
                .collect()
        }
    }
}

/// Where the old variables of a chart stand among its new ones.
fn standing(model: &Model, chart: &Chart, first: u16) -> Vec<Standing> {
    let scalars = |components: &[Component]| {
        let place = |(component, new): (&Component, u16)| {
            let is_scalar = model.groups[usize::from(component.group)].shape == Shape::Scalar;
            let row = component.row.filter(|_| !is_scalar);
            Standing {
                old: (component.group, row),
                new,
            }
        };
        components.iter().zip(first..).map(place).collect()
    };
    match chart {
        Chart::Polar(components) => scalars(components),
        Chart::Spherical(components) => scalars(components),
        Chart::Jacobi(bodies) | Chart::Heliocentric(bodies) => vec![Standing {
            old: (bodies.group, None),
            new: first,
        }],
    }
}

fn masses_of(model: &Model, dag: &mut Dag, parameter: crate::dag::Parameter) -> Masses {
    let shape = &model.parameters[usize::from(parameter.0)].shape;
    let (rows, _) = extents(shape).unwrap_or((0, 0));
    let each = (0..rows)
        .map(|row| dag.element(Array::Parameter(parameter), Index::constant(row), None))
        .collect();
    Masses::new(dag, each)
}

fn to_new(chart: &Chart, model: &Model, dag: &mut Dag, old: &Variables) -> Variables {
    match chart {
        Chart::Polar(_) => charts::polar_to_new(dag, old),
        Chart::Spherical(_) => charts::spherical_to_new(dag, old),
        Chart::Jacobi(bodies) => {
            let masses = masses_of(model, dag, bodies.masses);
            charts::jacobi_to_new(dag, old, &masses)
        }
        Chart::Heliocentric(_) => charts::heliocentric_to_new(dag, old),
    }
}

fn to_old(
    chart: &Chart,
    model: &Model,
    dag: &mut Dag,
    new: &Variables,
    rules: &mut Rules,
) -> Variables {
    match chart {
        Chart::Polar(_) => charts::polar_to_old(dag, new, rules),
        Chart::Spherical(_) => charts::spherical_to_old(dag, new, rules),
        Chart::Jacobi(bodies) => {
            let masses = masses_of(model, dag, bodies.masses);
            charts::jacobi_to_old(dag, new, &masses)
        }
        Chart::Heliocentric(_) => charts::heliocentric_to_old(dag, new),
    }
}

fn entries<'a>(slots: &'a [Slot], values: &'a Variables) -> impl Iterator<Item = VectorEntry> + 'a {
    [(Side::Q, &values.q), (Side::P, &values.p)]
        .into_iter()
        .flat_map(move |(side, values)| {
            slots
                .iter()
                .zip(values)
                .map(move |(slot, value)| VectorEntry {
                    side,
                    group: slot.group,
                    row: Index::constant(i64::from(slot.row)),
                    column: slot.column,
                    value: *value,
                })
        })
}

/// The model whose arena the new system is built in, with all roots (H, observables, carried ones),
/// written out where a loop reads a replaced coordinate.
fn written_out(
    model: &Model,
    layout: &Layout,
    carried: &[Node],
) -> Result<(Model, Vec<Node>), Refusal> {
    let mut roots: Vec<Node> = model.hamiltonian.into_iter().collect();
    for observable in &model.observables {
        roots.extend(&observable.components);
    }
    roots.extend(carried);
    let looped =
        model
            .dag
            .reachable(&roots)
            .into_iter()
            .find_map(|node| match model.dag.kind(node) {
                Kind::Element(Array::Phase { group, .. }, row, _)
                    if layout.replaced.contains(group)
                        && (row.modulo.is_some() || row.affine.as_constant().is_none()) =>
                {
                    Some(*group)
                }
                _ => None,
            });
    let Some(group) = looped else {
        return Ok((model.clone(), roots));
    };
    let refused = |reason: String| Refusal::Loops {
        coordinate: coordinate(model, group),
        reason,
    };
    if let Some(size) = model.sizes.first() {
        return Err(refused(format!("the size `{size}` is not a literal")));
    }
    loops::unroll_nodes(model, &[], &roots).map_err(refused)
}

/// What replaces each element that is read: old coordinates by the map, kept ones by their new
/// number.
fn images(
    dag: &mut Dag,
    roots: &[Node],
    inverse: &[VectorEntry],
    kept: &[(u16, u16)],
) -> Map<Node, Node> {
    let mut images: Map<Node, Node> = Map::default();
    for entry in inverse {
        let array = Array::Phase {
            side: entry.side,
            group: entry.group,
            column: entry.column,
        };
        let old = dag.element(array, entry.row.clone(), None);
        images.insert(old, entry.value);
    }
    for node in dag.reachable(roots) {
        if images.contains_key(&node) {
            continue;
        }
        let Kind::Element(array, row, _) = dag.kind(node).clone() else {
            continue;
        };
        let Array::Phase {
            side,
            group,
            column,
        } = array
        else {
            continue;
        };
        let Some((_, group)) = kept.iter().find(|(old, _)| *old == group) else {
            continue;
        };
        let moved = Array::Phase {
            side,
            group: *group,
            column,
        };
        let moved = dag.element(moved, row, None);
        images.insert(node, moved);
    }
    images
}

/// Puts the images of the roots where they belong; the rest is what was carried.
fn distribute(model: &mut Model, roots: Vec<Node>) -> Vec<Node> {
    let mut roots = roots.into_iter();
    model.hamiltonian = model.hamiltonian.and_then(|_| roots.next());
    for observable in &mut model.observables {
        observable.components = roots.by_ref().take(observable.components.len()).collect();
    }
    roots.collect()
}
