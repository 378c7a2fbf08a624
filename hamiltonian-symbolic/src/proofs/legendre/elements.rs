//! Elements of an array that differ from its others: L names them apart, counts them with a sum
//! over all, or leaves them out.
//!
//! Input: momenta and masses of element k in 0..rows. Output: the same in a form that shows whose
//! velocities they depend on, and the elements where a mass is 0. Invariant: a rewritten expression has
//! the same value for every k in 0..rows and all sizes; an element is said to have no mass only if
//! that is proven for it at some sizes.

use crate::dag::{Array, Dag, Kind, Map, Node, Relation};
use crate::index::{Affine, Domain, Index, Size};
use crate::list::IntoList;
use crate::loops::unroll_nodes;
use crate::model::Model;
use crate::normal_form::{Proof, is_zero};
use crate::rational::Rational;

/// Numbers up to this one are told from others where sizes are tried.
const LARGEST: i64 = 64;

/// Under a condition `index = k`, elements of these arrays at `index` are written as their elements k.
pub(super) fn at_own_index(dag: &mut Dag, root: Node, k: Domain, arrays: &[Array]) -> Node {
    let own = Index::of_loop(k);
    dag.substitute(root, |dag, node| {
        let Kind::Select(condition, then, otherwise) = *dag.kind(node) else {
            return None;
        };
        let Kind::Compare(Relation::Equal, index, of) = *dag.kind(condition) else {
            return None;
        };
        if *dag.kind(of) != Kind::Variable(k) {
            return None;
        }
        let then = dag.substitute(then, |dag, leaf| match dag.kind(leaf).clone() {
            Kind::Element(array, row, None)
                if arrays.contains(&array)
                    && row.modulo.is_none()
                    && row.outer.is_none()
                    && dag.affine(&row.affine) == index =>
            {
                Some(dag.element(array, own.clone(), None))
            }
            _ => None,
        });
        Some(dag.select(condition, then, otherwise))
    })
}

/// Pieces for the first or last element and for all others as one condition:
/// `(if 0 = k { a } else { 0 }) + (if 1 <= k { b } else { 0 })` is `if 1 <= k { b } else { a }`.
pub(super) fn merged(dag: &mut Dag, entry: Node, k: Domain) -> Node {
    let Kind::Sum(constant, terms) = dag.kind(entry).clone() else {
        return entry;
    };
    let is_piece = |dag: &Dag, term: Node| match dag.kind(term) {
        Kind::Select(condition, ..) => dag.variables(*condition).has(k),
        _ => false,
    };
    // Nothing is made where there is nothing to merge: the order of nodes is that of the code.
    if !terms.iter().any(|(_, term)| is_piece(dag, *term)) {
        return entry;
    }
    let rows = dag.range(k).end.clone();
    let (variable, one) = (Affine::variable(k), Affine::constant(1));
    let element = dag.variable(k);
    let last = rows.plus(-1, &one);
    let (first_index, last_index) = (dag.integer(0), dag.affine(&last));
    let is_later = dag.at_least_zero(&variable.plus(-1, &one));
    let is_earlier = dag.at_least_zero(&last.plus(-1, &one).plus(-1, &variable));
    let mut rest: Vec<(Rational, Node)> = Vec::new();
    type Terms = Vec<(Rational, Node)>;
    let mut pieces: Vec<(Node, Terms, Terms)> = Vec::new();
    for (factor, term) in terms {
        let Kind::Select(condition, then, otherwise) = *dag.kind(term) else {
            rest.push((factor, term));
            continue;
        };
        if !is_piece(dag, term) {
            rest.push((factor, term));
            continue;
        }
        let (condition, then, otherwise) = match *dag.kind(condition) {
            Kind::Compare(Relation::Equal, index, of) if of == element => {
                if index == first_index {
                    (is_later, otherwise, then)
                } else if index == last_index {
                    (is_earlier, otherwise, then)
                } else {
                    (condition, then, otherwise)
                }
            }
            _ => (condition, then, otherwise),
        };
        let at = pieces.iter().position(|(known, ..)| *known == condition);
        let at = at.unwrap_or_else(|| {
            pieces.push((condition, Vec::new(), Vec::new()));
            pieces.len() - 1
        });
        pieces[at].1.push((factor.clone(), then));
        pieces[at].2.push((factor, otherwise));
    }
    for (condition, then, otherwise) in pieces {
        let then = dag.linear(&Rational::ZERO, &then);
        let otherwise = dag.linear(&Rational::ZERO, &otherwise);
        rest.push((Rational::ONE, dag.select(condition, then, otherwise)));
    }
    dag.linear(&constant, &rest)
}

/// An element k where the expression is 0 whatever its variables are, though it is not 0 for all k:
/// at the ends, or near the numbers that occur in it, for sizes above all of these.
pub(super) fn zero_at(model: &Model, entry: Node, k: Domain) -> Option<Affine> {
    if is_the_same_for_all(&model.dag, entry, k) {
        return None;
    }
    let reach = largest_number(&model.dag, entry);
    let edge = 2 * reach + 4;
    let rows = model.dag.range(k).end.clone();
    // Both parities, if sizes are unknown.
    let sizes: &[i64] = match model.sizes.is_empty() {
        true => &[0],
        false => &[2 * reach + 5, 2 * reach + 6],
    };
    for &size in sizes {
        let count = rows.value(&|_| 0, &|_: Size| size);
        let places: Vec<i64> = (0..count.min(edge))
            .chain((count - edge).max(edge)..count)
            .into_list();
        // Loops that depend on k are not the definition's.
        let mut copy = model.clone();
        let mut images = Vec::with_capacity(places.len());
        for &at in &places {
            images.push(copy.dag.replace(entry, k, &Affine::constant(at)));
        }
        if copy.dag.has_too_many_loops() {
            return None;
        }
        let Ok((numbers, values)) = unroll_nodes(&copy, &vec![size; model.sizes.len()], &images)
        else {
            continue;
        };
        let zero = values
            .iter()
            .position(|value| is_zero(&numbers, *value) == Proof::Zero);
        if let Some(found) = zero {
            let at = places[found];
            let from_end = Affine::constant(count - at);
            return Some(if 2 * at < count {
                Affine::constant(at)
            } else {
                rows.plus(-1, &from_end)
            });
        }
    }
    None
}

/// Returns true if the expression for one k is that for another but for the names of the elements it reads.
fn is_the_same_for_all(dag: &Dag, root: Node, k: Domain) -> bool {
    if !dag.variables(root).has(k) {
        return true;
    }
    let own = Index::of_loop(k);
    let mut reads: Map<Array, bool> = Map::default();
    for node in dag.reachable(&[root]) {
        let is_same = match dag.kind(node) {
            Kind::Element(array, row, column) => {
                let of_k = *row == own && column.as_ref().is_none_or(|c| !c.variables().has(k));
                let depends = dag.variables(node).has(k);
                of_k == depends && *reads.entry(*array).or_insert(of_k) == of_k
            }
            Kind::Variable(domain) => *domain != k,
            Kind::Count(domain) | Kind::Reduce(domain, _) => {
                let range = dag.range(*domain);
                !(range.start.variables() | range.end.variables()).has(k)
            }
            _ => true,
        };
        if !is_same {
            return false;
        }
    }
    true
}

/// The largest whole number in the expression, within bounds.
fn largest_number(dag: &Dag, root: Node) -> i64 {
    let mut largest = 1;
    let whole = |value: &Rational| match value.to_small() {
        Some((n, 1)) => n.abs(),
        _ => 0,
    };
    for node in dag.reachable(&[root]) {
        let found = match dag.kind(node) {
            Kind::Constant(value) => whole(value),
            Kind::Sum(value, terms) => {
                let factors = terms.iter().map(|(factor, _)| whole(factor));
                factors.max().unwrap_or(0).max(whole(value))
            }
            Kind::Element(_, row, _) => {
                let constants = row.axes().into_iter();
                let constants = constants.map(|axis| axis.affine.constant.saturating_abs());
                constants.max().unwrap_or(0)
            }
            Kind::Count(domain) | Kind::Reduce(domain, _) => {
                let range = dag.range(*domain);
                let start = range.start.constant.saturating_abs();
                start.max(range.end.constant.saturating_abs())
            }
            _ => 0,
        };
        largest = largest.max(found);
    }
    largest.min(LARGEST)
}
