//! The Poisson bracket of two expressions.
//!
//! Input: two nodes. Output: {a, b} = Σ ∂a/∂q·∂b/∂p − ∂a/∂p·∂b/∂q. Invariant: only where every
//! coordinate that occurs is named by number; a coordinate inside a loop stands for many.

use hamiltonian_symbolic::dag::{Array, Dag, Dependence, Kind, Node, Side};
use hamiltonian_symbolic::diff;
use hamiltonian_symbolic::rational::Rational;

/// The bracket; `None` if a coordinate stands inside a loop.
pub fn bracket(dag: &mut Dag, a: Node, b: Node) -> Option<Node> {
    let both = Dependence(Dependence::Q.0 | Dependence::P.0);
    let of_a = diff::gradient(dag, a, both);
    let of_b = diff::gradient(dag, b, both);
    let mut terms = Vec::new();
    for (leaf, value) in of_a.iter().chain(&of_b) {
        if dag.variables(*leaf) | dag.variables(*value) != 0 {
            return None;
        }
    }
    for &(leaf, value) in &of_a {
        let Kind::Element(
            Array::Phase {
                side,
                group,
                column,
            },
            row,
            _,
        ) = dag.kind(leaf).clone()
        else {
            continue;
        };
        let (other, sign) = match side {
            Side::Q => (Side::P, Rational::ONE),
            Side::P => (Side::Q, Rational::MINUS_ONE),
        };
        let conjugate = dag.element(
            Array::Phase {
                side: other,
                group,
                column,
            },
            row,
            None,
        );
        if let Some((_, partial)) = of_b.iter().find(|(known, _)| *known == conjugate) {
            terms.push((sign, dag.mul(&[value, *partial])));
        }
    }
    Some(dag.linear(&Rational::ZERO, &terms))
}
