//! Velocities: variables of a Lagrangian, and functions of (q, p, t) everywhere else.
//!
//! Input: expressions of velocities. Output: expressions with momenta in their place, for the
//! Legendre transform, or with the functions of (q, p, t) that the transform computed.

use hamiltonian_symbolic::dag::{Array, Column, Dag, Kind, Node, Side};
use hamiltonian_symbolic::index::{Affine, Domain, Index};
use hamiltonian_symbolic::legendre::ElementMap;
use hamiltonian_symbolic::list::IntoList;
use hamiltonian_symbolic::loops::unrolled;
use hamiltonian_symbolic::model::{Model, VectorEntry};

/// The expression with velocities in the place of momenta.
pub fn as_momenta(dag: &mut Dag, root: Node) -> Node {
    dag.substitute(root, Dag::momentum_in_place)
}

/// The expression with velocities as functions of (q, p, t); `None` if a velocity depends on its
/// own index and stands at an index that wraps around, which is not a number.
pub fn as_functions(model: &mut Model, root: Node, velocities: &[ElementMap]) -> Option<Node> {
    let root = peeled(model, root, velocities)?;
    let dag = &mut model.dag;
    let mut whole = true;
    let image = dag.substitute(root, |dag, node| {
        let Kind::Element(Array::Velocity(velocity), row, None) = dag.kind(node).clone() else {
            return None;
        };
        for component in velocities {
            let Some((column, place)) = dag.phase_place(component.element) else {
                continue;
            };
            if column != velocity.on(Side::P) {
                continue;
            }
            match component.domain {
                None if *place == row => return Some(component.value),
                Some(domain) if row.modulo.is_none() => {
                    return Some(dag.replace(component.value, domain, &row.affine));
                }
                Some(domain) => {
                    if let Some(image) = wrapped(dag, component.value, domain, &row) {
                        return Some(image);
                    }
                }
                _ => {}
            }
        }
        whole = false;
        None
    });
    whole.then_some(image)
}

/// The expression, with loops unrolled that read coupled velocities, which the transform unrolled.
fn peeled(model: &mut Model, root: Node, velocities: &[ElementMap]) -> Option<Node> {
    let dag = &model.dag;
    let is_written_out = |wanted: u16| {
        velocities.iter().any(|component| {
            let column = dag.phase_place(component.element);
            let is_of = |(column, _): (Column, &Index)| column.group == wanted;
            column.is_some_and(is_of) && component.domain.is_none()
        })
    };
    let is_looped = |node: Node| match dag.kind(node) {
        Kind::Element(Array::Velocity(Column { group, .. }), row, _) => {
            !row.variables().is_empty() && is_written_out(*group)
        }
        _ => false,
    };
    if dag.reachable(&[root]).into_iter().any(is_looped) {
        unrolled(model, root).ok()
    } else {
        Some(root)
    }
}

/// An expression of the loop variable `k` at an index with a modulus; `None` if `k` also stands
/// outside indices.
fn wrapped(dag: &mut Dag, root: Node, k: Domain, at: &Index) -> Option<Node> {
    let modulo = at.modulo.clone()?;
    let mut whole = true;
    let image = dag.substitute(root, |dag, node| {
        if !dag.variables(node).has(k) {
            return Some(node);
        }
        let (array, row, column) = match dag.kind(node) {
            Kind::Element(array, row, column) => (*array, row.clone(), column.as_deref().cloned()),
            Kind::Variable(_) | Kind::Count(_) => {
                whole = false;
                return None;
            }
            Kind::Reduce(domain, _) => {
                let range = dag.range(*domain);
                whole &= !(range.start.variables() | range.end.variables()).has(k);
                return None;
            }
            _ => return None,
        };
        let shifted = row.affine.substitute(|domain| {
            if domain == k {
                at.affine.clone()
            } else {
                Affine::variable(domain)
            }
        });
        let is_plain = row.modulo.is_none() && row.affine == Affine::variable(k);
        let of_k = column.as_ref().is_some_and(|c| c.variables().has(k));
        // (i mod n + c) mod n = (i + c) mod n
        if of_k || !(is_plain || row.modulo.as_ref() == Some(&modulo)) {
            whole = false;
            return None;
        }
        Some(dag.element(array, Index::wrapped(shifted, modulo.clone()), column))
    });
    whole.then_some(image)
}

/// The components as entries of a vector on one side.
pub fn entries(dag: &Dag, components: &[ElementMap], side: Side) -> Vec<VectorEntry> {
    let entry = |component: &ElementMap| {
        let (column, row) = dag.phase_place(component.element)?;
        Some(VectorEntry {
            at: column.on(side),
            row: row.clone(),
            value: component.value,
        })
    };
    components.iter().filter_map(entry).into_list()
}
