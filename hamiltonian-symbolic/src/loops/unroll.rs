//! A system unrolled at given sizes.
//!
//! Input: a model and a value for each of its sizes. Output: a model of the same system without
//! loops, its array elements at constant indices. Invariant: every index is inside its array; no
//! more than [`LARGEST`] nodes are made.

use super::walk::{Meaning, Place, walk};
use crate::dag::{Array, Dag, Kind, Map, Node};
use crate::index::{Affine, Index};
use crate::model::{Model, Shape};
use crate::transform::REPLACING;

/// The most nodes a system unrolled may have.
pub const LARGEST: usize = 1 << 20;

/// The system at the given sizes, without loops; observables included.
///
/// # Errors
/// A sentence, where an index is outside its array at these sizes or the result is too large.
pub fn unroll(model: &Model, sizes: &[i64]) -> Result<Model, String> {
    let mut roots: Vec<Node> = model.hamiltonian.into_iter().collect();
    for observable in &model.observables {
        roots.extend(&observable.components);
    }
    let (mut unrolled, images) = unroll_nodes(model, sizes, &roots)?;
    let mut images = images.into_iter();
    unrolled.hamiltonian = model.hamiltonian.and_then(|_| images.next());
    for observable in &mut unrolled.observables {
        observable.components = images.by_ref().take(observable.components.len()).collect();
    }
    Ok(unrolled)
}

/// The given nodes at the given sizes, over the arena of a new model with the same names, whose
/// shapes are literal, so that it has no sizes. Its H and observables are left as they were and mean
/// nothing.
///
/// # Errors
/// As [`unroll`].
pub fn unroll_nodes(
    model: &Model,
    sizes: &[i64],
    roots: &[Node],
) -> Result<(Model, Vec<Node>), String> {
    let mut unrolled = model.clone();
    unrolled.dag = Dag::new();
    unrolled.sizes.clear();
    let place = Place::new(sizes);
    let literal = |shape: &mut Shape| match shape {
        Shape::Scalar => {}
        Shape::Vector(rows) => *rows = Affine::constant(place.affine(rows)),
        Shape::Matrix(rows, columns) => {
            *rows = Affine::constant(place.affine(rows));
            *columns = Affine::constant(place.affine(columns));
        }
    };
    unrolled
        .groups
        .iter_mut()
        .for_each(|g| literal(&mut g.shape));
    unrolled
        .parameters
        .iter_mut()
        .for_each(|p| literal(&mut p.shape));
    let (images, unroller) = walk(
        &model.dag,
        roots,
        sizes,
        Unroller {
            model: unrolled,
            trouble: None,
        },
    );
    match (images, unroller.trouble) {
        (Some(images), None) => Ok((unroller.model, images)),
        (_, trouble) => Err(trouble.unwrap_or_else(|| "the walk ended early".to_owned())),
    }
}

/// A node of the model without its loops, in the model's own arena. All sizes must be literal.
///
/// # Errors
/// As [`unroll`].
pub fn write_out(model: &mut Model, root: Node) -> Result<Node, String> {
    let (unrolled, images) = unroll_nodes(model, &[], &[root])?;
    let mut new: Map<Node, Node> = Map::default();
    for node in unrolled.dag.reachable(&images) {
        let kind = with_children(unrolled.dag.kind(node), &|child| new[&child]);
        new.insert(node, model.dag.of_kind(kind));
    }
    Ok(new[&images[0]])
}

/// A kind over other children.
fn with_children(kind: &Kind, child: &dyn Fn(Node) -> Node) -> Kind {
    let mut kind = kind.clone();
    match &mut kind {
        Kind::Sum(_, terms) => terms.iter_mut().for_each(|(_, n)| *n = child(*n)),
        Kind::Product(_, factors) => factors.iter_mut().for_each(|(n, _)| *n = child(*n)),
        Kind::Call(_, arguments) | Kind::External(_, _, arguments) => {
            arguments.iter_mut().for_each(|n| *n = child(*n));
        }
        Kind::Not(a) => *a = child(*a),
        Kind::Compare(_, a, b) | Kind::And(a, b) | Kind::Or(a, b) => {
            (*a, *b) = (child(*a), child(*b));
        }
        Kind::Select(c, a, b) => (*c, *a, *b) = (child(*c), child(*a), child(*b)),
        _ => {}
    }
    kind
}

struct Unroller {
    model: Model,
    trouble: Option<String>,
}

impl Unroller {
    /// The value of an index, which must be inside its extent.
    fn inside(&mut self, name: &str, index: i64, extent: &Affine) -> i64 {
        let extent = extent.as_constant().unwrap_or(0);
        if self.trouble.is_none() && !(0..extent).contains(&index) {
            self.trouble = Some(format!("`{name}[{index}]` is outside 0..{extent}"));
        }
        index
    }
}

impl Meaning for Unroller {
    type Value = Node;

    fn value(
        &mut self,
        dag: &Dag,
        node: Node,
        place: &Place,
        child: &dyn Fn(Node) -> Node,
    ) -> Node {
        match dag.kind(node) {
            Kind::Element(array, row, column) => {
                let (name, shape) = match array {
                    Array::Phase { group, .. } | Array::Direction { group, .. } => {
                        // What stands in the place of a group is of its shape.
                        let group = &self.model.groups[usize::from(*group % REPLACING)];
                        (group.coordinate.clone(), group.shape.clone())
                    }
                    Array::Parameter(parameter) => {
                        let declared = &self.model.parameters[usize::from(parameter.0)];
                        (declared.name.clone(), declared.shape.clone())
                    }
                };
                let mut row = place.index(row);
                let mut column = column.as_ref().map(|c| place.index(c));
                match shape {
                    Shape::Scalar => {}
                    Shape::Vector(rows) => row = self.inside(&name, row, &rows),
                    Shape::Matrix(rows, columns) => {
                        row = self.inside(&name, row, &rows);
                        column = column.map(|c| self.inside(&name, c, &columns));
                    }
                }
                self.model
                    .dag
                    .element(*array, Index::constant(row), column.map(Index::constant))
            }
            Kind::Variable(domain) => self.model.dag.integer(place.variable(*domain)),
            Kind::Extent(size) => self.model.dag.integer(place.size(*size)),
            Kind::Count(domain) => self.model.dag.integer(place.count(dag, *domain)),
            kind => self.model.dag.of_kind(with_children(kind, child)),
        }
    }

    fn total(&mut self, parts: Vec<Node>) -> Node {
        self.model.dag.add(&parts)
    }

    fn is_done(&self) -> bool {
        self.trouble.is_some() || self.model.dag.len() > LARGEST
    }
}

impl Dag {
    /// The node of a kind whose children are nodes of this arena, by the constructors' rules.
    fn of_kind(&mut self, kind: Kind) -> Node {
        match kind {
            Kind::Constant(value) => self.constant(value),
            Kind::Sum(c, terms) => self.linear(&c, &terms),
            Kind::Product(k, factors) => self.product(&k, &factors),
            Kind::Call(op, arguments) => self.call(op, &arguments),
            Kind::External(function, part, arguments) => self.external(function, part, &arguments),
            Kind::Not(a) => self.not(a),
            Kind::And(a, b) => self.and(a, b),
            Kind::Or(a, b) => self.or(a, b),
            Kind::Select(c, a, b) => self.select(c, a, b),
            other => self.intern(other),
        }
    }
}
