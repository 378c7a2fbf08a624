//! The Poisson bracket as an expression.
//!
//! Input: two expressions. Output: {a, b} = Σ ∂a/∂q ∂b/∂p − ∂a/∂p ∂b/∂q, loops as loops.
//! Invariant: derivatives with respect to array elements are lists of scatters (every iteration
//! adds a value to an element); a product of two such lists is a sum over the scatters of one of
//! the derivative of the other at the element scattered to.

use crate::dag::{Array, Dag, Dependence, Kind, Node, Side};
use crate::diff;
use crate::index::{Affine, Domain, Index};
use crate::list::IntoList;
use crate::loops::{field, unrolled};
use crate::model::{Model, VectorEntry};
use crate::ranges::Ranges;
use crate::rational::Rational;

/// {a, b}; `None` where an array's derivatives cannot be brought together, as their indices
/// cannot be solved for loop variables, or where that takes too many loops. Where all sizes are
/// literal there are no indices left to solve once the sums are unrolled.
pub fn bracket(model: &mut Model, a: Node, b: Node) -> Option<Node> {
    in_loops(model, a, b, &[]).or_else(|| {
        if !model.sizes.is_empty() || model.dag.has_too_many_loops() {
            return None;
        }
        let (a, b) = (unrolled(model, a).ok()?, unrolled(model, b).ok()?);
        in_loops(model, a, b, &[])
    })
}

/// {a, H} + f·∂a/∂p with the model's force f: the time derivative of `a` but for ∂a/∂t.
pub fn along_flow(model: &mut Model, a: Node, h: Node) -> Option<Node> {
    if model.force.is_empty() {
        return bracket(model, a, h);
    }
    let force = model.force.clone();
    in_loops(model, a, h, &force)
}

/// {a, b}, loops as loops, with a force f that acts as if ∂b/∂q were ∂b/∂q − f.
fn in_loops(model: &mut Model, a: Node, b: Node, force: &[VectorEntry]) -> Option<Node> {
    let columns = model.columns(Side::Q);
    let dag = &mut model.dag;
    let (aq, ap) = (
        diff::gradient(dag, a, Dependence::Q),
        diff::gradient(dag, a, Dependence::P),
    );
    let (mut bq, bp) = (
        diff::gradient(dag, b, Dependence::Q),
        diff::gradient(dag, b, Dependence::P),
    );
    for entry in force {
        let leaf = dag.phase(entry.at.on(Side::Q), entry.row.clone());
        bq.push((leaf, dag.neg(entry.value)));
    }
    let mut terms: Vec<(Rational, Node)> = Vec::new();
    for (q, rows) in columns {
        let rows = rows.unwrap_or_else(|| Affine::constant(1));
        for (x, y, side) in [(&aq, &bp, Side::Q), (&ap, &bq, Side::P)] {
            let sign = match side {
                Side::Q => Rational::ONE,
                Side::P => Rational::MINUS_ONE,
            };
            let at = q.on(side);
            let (x, y) = (
                scatters(dag, x, Array::Phase(at)),
                scatters(dag, y, Array::Phase(at.conjugate())),
            );
            for term in paired(dag, &x, &y, &rows)? {
                terms.push((sign.clone(), term));
            }
        }
    }
    let sum = dag.linear(&Rational::ZERO, &terms);
    (!dag.has_too_many_loops()).then_some(sum)
}

/// Every iteration of the loops around adds a value to an element.
#[derive(Clone, Debug)]
struct Scatter {
    leaf: Node,
    row: Index,
    chain: Vec<Domain>,
    value: Node,
}

fn scatters(dag: &Dag, leaves: &[(Node, Node)], array: Array) -> Vec<Scatter> {
    leaves
        .iter()
        .filter_map(|&(leaf, value)| match dag.kind(leaf) {
            Kind::Element(of, row, None) if *of == array => Some(Scatter {
                leaf,
                row: row.clone(),
                chain: dag.path(dag.home(leaf)),
                value,
            }),
            _ => None,
        })
        .into_list()
}

/// Σ over elements of the product of two derivatives.
fn paired(dag: &mut Dag, x: &[Scatter], y: &[Scatter], rows: &Affine) -> Option<Vec<Node>> {
    if x.is_empty() || y.is_empty() {
        return Some(Vec::new());
    }
    // The side whose derivative is plain as a function of the element is read at the elements the
    // other side scatters to.
    let plain = |dag: &Dag, list: &[Scatter]| list.iter().all(|s| is_plain(dag, s, rows));
    if plain(dag, y) || !plain(dag, x) {
        gathered(dag, x, y, rows).or_else(|| gathered(dag, y, x, rows))
    } else {
        gathered(dag, y, x, rows).or_else(|| gathered(dag, x, y, rows))
    }
}

/// Returns true if each iteration of one loop writes one element, and all of them together all elements.
fn is_plain(dag: &Dag, scatter: &Scatter, rows: &Affine) -> bool {
    let [domain] = scatter.chain.as_slice() else {
        return false;
    };
    dag.runs_over(*domain, rows)
        && (scatter.row == Index::of_loop(*domain) || dag.rotation(&scatter.row, *domain).is_some())
}

fn gathered(dag: &mut Dag, x: &[Scatter], y: &[Scatter], rows: &Affine) -> Option<Vec<Node>> {
    let k = field::elements(dag, rows);
    let leaves: Vec<(Node, Node)> = y.iter().map(|s| (s.leaf, s.value)).into_list();
    let Kind::Element(array, ..) = *dag.kind(y.first()?.leaf) else {
        return None;
    };
    let value = field::field(dag, &leaves, array, rows)?;
    let mut terms = Vec::new();
    for scatter in x {
        let row = dag.unwrapped(scatter.row.clone());
        let there = dag.reindexed(value, k, &row)?;
        let mut term = dag.mul(&[scatter.value, there]);
        for &domain in scatter.chain.iter().rev() {
            term = dag.reduce(domain, term);
        }
        terms.push(term);
    }
    Some(terms)
}
