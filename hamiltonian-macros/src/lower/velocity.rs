//! Velocities: variables of a Lagrangian, and functions of (q, p, t) everywhere else.
//!
//! Input: expressions in which velocities are marked elements. Output: expressions in which they
//! are elements in the place of momenta (for the Legendre transform), or what it made of them.
//! Invariant: until then a velocity is an element of the direction that Hessians are multiplied
//! with, which nothing else in a definition reads.

use hamiltonian_symbolic::dag::{Array, Dag, Kind, Node, Side};
use hamiltonian_symbolic::legendre::Component;
use hamiltonian_symbolic::model::VectorEntry;

/// The mark of a velocity, from the momentum element of its place.
pub fn marked(dag: &mut Dag, momentum: Node) -> Node {
    match dag.kind(momentum).clone() {
        Kind::Element(Array::Phase { group, column, .. }, row, None) => {
            let array = Array::Direction {
                side: Side::P,
                group,
                column,
            };
            dag.element(array, row, None)
        }
        _ => momentum,
    }
}

/// The expression with velocities in the place of momenta.
pub fn as_momenta(dag: &mut Dag, root: Node) -> Node {
    dag.substitute(root, |dag, node| match dag.kind(node).clone() {
        Kind::Element(
            Array::Direction {
                side: Side::P,
                group,
                column,
            },
            row,
            None,
        ) => {
            let array = Array::Phase {
                side: Side::P,
                group,
                column,
            };
            Some(dag.element(array, row, None))
        }
        _ => None,
    })
}

/// The expression with velocities as functions of (q, p, t); `None` where one stands at an index
/// that wraps around, whose function cannot be written there.
pub fn as_functions(dag: &mut Dag, root: Node, velocities: &[Component]) -> Option<Node> {
    let mut whole = true;
    let image = dag.substitute(root, |dag, node| {
        let Kind::Element(Array::Direction { group, column, .. }, row, None) =
            dag.kind(node).clone()
        else {
            return None;
        };
        for component in velocities {
            let Kind::Element(array, place, _) = dag.kind(component.element).clone() else {
                continue;
            };
            let wanted = Array::Phase {
                side: Side::P,
                group,
                column,
            };
            if array != wanted {
                continue;
            }
            match component.domain {
                None if place == row => return Some(component.value),
                Some(domain) if row.modulo.is_none() => {
                    return Some(dag.replace(component.value, domain, &row.affine));
                }
                _ => {}
            }
        }
        whole = false;
        None
    });
    whole.then_some(image)
}

/// The components as entries of a vector on one side.
pub fn entries(dag: &Dag, components: &[Component], side: Side) -> Vec<VectorEntry> {
    let entry = |component: &Component| match dag.kind(component.element).clone() {
        Kind::Element(Array::Phase { group, column, .. }, row, _) => Some(VectorEntry {
            side,
            group,
            column,
            row,
            value: component.value,
        }),
        _ => None,
    };
    components.iter().filter_map(entry).collect()
}
