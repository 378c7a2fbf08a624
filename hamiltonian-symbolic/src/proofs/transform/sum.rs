//! The comparison of H with the sum of declared pieces.
//!
//! Input: a model with its H, and the pieces as nodes. Output: nothing, or the difference. Invariant: a sum
//! that passes is proven equal to H by the normal form. If the normal form does not decide, the difference
//! is reported.

use crate::dag::work;
use crate::dag::{Dag, Node};
use crate::list::IntoList;
use crate::loops::SamplePoint;
use crate::model::Model;
use crate::normal_form::{self, Proof, Scope};
use crate::print;
use crate::rational::Rational;
use crate::structure::expand;

/// H is not the sum of its pieces, or was not shown to be.
#[derive(Clone, PartialEq, Debug)]
pub struct Difference {
    /// H − Σ pieces, multiplied out.
    pub node: Node,
    /// The text of the term.
    pub text: String,
    /// A point where it is not 0, and its value there; `None` if no point was found, which leaves
    /// the comparison undecided.
    pub point: Option<(SamplePoint, f64)>,
    /// The rule or the limit that stopped the proof, as a clause; empty beside a point.
    pub why: String,
}

/// Checks that the pieces add up to H: Σ A = H as functions of (q, p, t), additive constants
/// included. Each piece is a Hamiltonian of its own.
///
/// # Errors
/// [`Difference`] with H − Σ A.
pub fn check_split(model: &mut Model, pieces: &[Node]) -> Result<(), Box<Difference>> {
    let h = model.h();
    let mut terms = vec![(Rational::ONE, h)];
    terms.extend(pieces.iter().map(|piece| (Rational::MINUS_ONE, *piece)));
    let difference = model.dag.linear(&Rational::ZERO, &terms);
    // Multiplied out first, so that the point names only variables of the difference.
    let node = multiplied_out(&mut model.dag, difference);
    let parts: Vec<Node> = terms.iter().map(|(_, part)| *part).into_list();
    let point = match normal_form::is_zero_where(model, node, &parts) {
        Proof::Zero => return Ok(()),
        Proof::NonZero { point, value } => Some((point, value)),
        Proof::Undecided => None,
    };
    Err(Box::new(Difference {
        node,
        text: print::text(model, node),
        why: match point {
            Some(_) => String::new(),
            None => normal_form::answer(&mut model.dag, node, Scope::Everywhere).why(),
        },
        point,
    }))
}

/// The node multiplied out and collected, or in its normal form where that is shorter.
fn multiplied_out(dag: &mut Dag, node: Node) -> Node {
    let expanded = match expand(dag, node) {
        Some(terms) => {
            let nodes: Vec<Node> = terms.iter().map(|term| term.node(dag)).into_list();
            dag.add(&nodes)
        }
        None => node,
    };
    let tidy = normal_form::tidy(dag, expanded);
    tidy.filter(|tidy| work(dag, &[*tidy]) < work(dag, &[expanded]))
        .unwrap_or(expanded)
}
