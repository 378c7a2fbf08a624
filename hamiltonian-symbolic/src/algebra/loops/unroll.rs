//! A system unrolled at given sizes.
//!
//! Input: a model and a value for each of its sizes. Output: a model of the same system without
//! loops, its array elements at constant indices. Invariant: every index is inside its array; no
//! more than [`LARGEST`] nodes are made.

use super::walk::{Environment, Meaning, walk};
use crate::dag::{Array, Dag, Kind, Node};
use crate::index::{Affine, Index};
use crate::model::{Model, Shape};

/// The most nodes a system unrolled may have.
pub const LARGEST: usize = 1 << 20;

/// The system at the given sizes, without loops: its [functions](Model::functions).
///
/// # Errors
/// A sentence, where an index is outside its array at these sizes or the result is too large.
pub fn unroll(model: &Model, sizes: &[i64]) -> Result<Model, String> {
    let (mut unrolled, images) = unroll_nodes(model, sizes, &model.functions())?;
    unrolled.set_roots(&images);
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
    let place = Environment::new(sizes);
    let literal = |extent: &mut Affine| *extent = Affine::constant(place.affine(extent));
    for group in &mut unrolled.groups {
        group.shape.for_each_extent(literal);
    }
    for parameter in &mut unrolled.parameters {
        parameter.shape.for_each_extent(literal);
        if let Shape::Matrix(_, columns) = &mut parameter.shape {
            literal(columns);
        }
    }
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
pub fn unrolled(model: &mut Model, root: Node) -> Result<Node, String> {
    let (unrolled, images) = unroll_nodes(model, &[], &[root])?;
    let nodes = unrolled.dag.reachable(&images);
    let new = model.dag.map(nodes, |dag, node, new| {
        dag.construct(unrolled.dag.kind(node).clone(), &|child| new[&child])
    });
    Ok(new[&images[0]])
}

struct Unroller {
    model: Model,
    trouble: Option<String>,
}

impl Unroller {
    /// The value of an index, which must be inside its extent.
    fn inside(&mut self, array: Array, index: i64, extent: i64) -> i64 {
        if self.trouble.is_none() && !(0..extent).contains(&index) {
            let name = self.model.array_name(array);
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
        place: &Environment,
        child: &dyn Fn(Node) -> Node,
    ) -> Node {
        match dag.kind(node) {
            Kind::Element(array, row, column) => {
                let mut row = place.index(row);
                let mut column = column.as_ref().map(|c| place.index(c));
                match self.model.shape(*array) {
                    Shape::Scalar => {}
                    Shape::Vector(rows) | Shape::Lattice(rows, _) => {
                        row = self.inside(*array, row, place.affine(&rows));
                    }
                    Shape::Matrix(rows, columns) => {
                        row = self.inside(*array, row, place.affine(&rows));
                        column = column.map(|c| self.inside(*array, c, place.affine(&columns)));
                    }
                }
                self.model
                    .dag
                    .element(*array, Index::constant(row), column.map(Index::constant))
            }
            Kind::Variable(domain) => self.model.dag.integer(place.variable(*domain)),
            Kind::Extent(size) => self.model.dag.integer(place.size(*size)),
            Kind::Count(domain) => self.model.dag.integer(place.count(dag, *domain)),
            kind => self.model.dag.construct(kind.clone(), child),
        }
    }

    fn total(&mut self, parts: Vec<Node>) -> Node {
        self.model.dag.add(&parts)
    }

    fn is_done(&self) -> bool {
        self.trouble.is_some() || self.model.dag.len() > LARGEST
    }
}
