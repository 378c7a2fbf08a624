//! Elements under a condition, made safe to read where the condition does not hold.
//!
//! Input: an expression as [`super::field`] makes them, such as `if 1 <= k { q[k - 1] } else { 0 }`.
//! Output: the same with indices that wrap around, `q[(k - 1) % N]`, wherever an index under a
//! condition is not in range for all values of its loop variables: code reads both branches.
//! Invariant: where the condition holds nothing changes.

use crate::dag::{Array, Dag, Kind, Map, Node};
use crate::index::{Affine, Index};
use crate::model::{Model, Shape};
use crate::ranges::Ranges;

/// The expression with safe indices; `None` where a loop under a condition may start below 0, or
/// an element has several axes, for which there is no such remedy. Safe indices are left as they are: indices that an author wrote
/// are in range whatever the conditions around them.
pub fn guarded(model: &mut Model, root: Node, is_safe: &dyn Fn(Node) -> bool) -> Option<Node> {
    let nodes = model.dag.reachable(&[root]);
    let mut is_under: Map<Node, ()> = Map::default();
    for &node in nodes.iter().rev() {
        let is_own = is_under.contains_key(&node);
        let dag = &model.dag;
        match dag.kind(node) {
            Kind::Select(condition, then, otherwise) => {
                is_under.insert(*then, ());
                is_under.insert(*otherwise, ());
                if is_own {
                    is_under.insert(*condition, ());
                }
            }
            _ if is_own => dag.for_children(node, |child| {
                is_under.insert(child, ());
            }),
            _ => {}
        }
    }
    if is_under.is_empty() {
        return Some(root);
    }
    // The model still has the shapes.
    let mut dag = std::mem::take(&mut model.dag);
    let new = dag.try_map(nodes, |dag, node, new| {
        let is_read = is_under.contains_key(&node) && !is_safe(node);
        match dag.kind(node).clone() {
            Kind::Element(_, row, _) if is_read && row.outer.is_some() => None,
            Kind::Element(array, row, column) if is_read => {
                let (rows, columns) = extents(model, array);
                let row = safe(dag, row, rows);
                let column = column.map(|column| safe(dag, *column, columns));
                Some(dag.element(array, row, column))
            }
            Kind::Reduce(domain, _)
                if is_read && !dag.is_never_negative(&dag.range(domain).start) =>
            {
                None
            }
            _ => Some(dag.rebuild(node, &|child| new[&child])),
        }
    });
    model.dag = dag;
    new.map(|new| new[&root])
}

/// The rows and columns of an array; `None` for an index that it does not have.
fn extents(model: &Model, array: Array) -> (Option<Affine>, Option<Affine>) {
    match model.shape(array) {
        Shape::Scalar => (None, None),
        Shape::Vector(rows) | Shape::Lattice(rows, _) => (Some(rows), None),
        Shape::Matrix(rows, columns) => (Some(rows), Some(columns)),
    }
}

/// The index if it is in range, wrapped around otherwise.
fn safe(dag: &Dag, index: Index, extent: Option<Affine>) -> Index {
    let Some(extent) = extent else {
        return index;
    };
    if index.modulo.is_some() || dag.is_within(&index.affine, &extent) {
        index
    } else {
        Index::wrapped(index.affine, extent)
    }
}
