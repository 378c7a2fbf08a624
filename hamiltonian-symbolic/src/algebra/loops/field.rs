//! The derivative with respect to element k of an array, as an expression of k.
//!
//! Input: adjoints as [`crate::diff::gradient`] leaves them, where `q[index]` in a loop means that
//! every iteration adds to that element. Output: one expression in the loop k in 0..rows: the
//! index is solved for a loop variable, the other loops become sums. Invariant: where an index
//! cannot be solved, a condition `index = k` is summed instead; where not even that can be said,
//! there is no answer.

use crate::dag::{Array, Dag, Kind, Node};
use crate::index::{Affine, Domain, Index, Loops};
use crate::list::IntoList;
use crate::ranges::Ranges;

/// The loop over the elements of an array with this many rows.
pub fn elements(dag: &mut Dag, rows: &Affine) -> Domain {
    dag.domain(None, Affine::constant(0), rows.clone())
}

/// `∂/∂array[k]` for k in 0..rows, in the loop that [`elements`] gives, from the adjoints of all
/// leaves; `None` where an index can be neither solved nor compared, or that takes too many loops.
pub fn field(dag: &mut Dag, leaves: &[(Node, Node)], array: Array, rows: &Affine) -> Option<Node> {
    let k = elements(dag, rows);
    let mut parts = Vec::new();
    for &(leaf, adjoint) in leaves {
        let Kind::Element(of, row, None) = dag.kind(leaf) else {
            continue;
        };
        if *of != array {
            continue;
        }
        let row = row.clone();
        let chain = dag.path(dag.home(leaf));
        parts.push(gather(dag, &row, &chain, adjoint, k, rows)?);
    }
    let sum = dag.add(&parts);
    (!dag.has_too_many_loops()).then_some(sum)
}

/// The sum of the contributions of all iterations of `chain` to element k.
fn gather(
    dag: &mut Dag,
    row: &Index,
    chain: &[Domain],
    adjoint: Node,
    k: Domain,
    rows: &Affine,
) -> Option<Node> {
    if row.outer.is_some() {
        let loops = dag.loops_of_rows(row, rows)?;
        return at_number(dag, row, loops, adjoint, k);
    }
    let Some(&outermost) = chain.first() else {
        return row
            .modulo
            .is_none()
            .then(|| where_equal(dag, &row.affine, k, adjoint));
    };
    let mut chain = chain.to_vec();
    let mut adjoint = adjoint;
    let mut row = row.clone();
    if chain.len() > 1 {
        // The loops around the innermost stand inside the loop over k, which one of them may be
        // the same as: the outermost gets a number of its own, and the others move along.
        let range = dag.range(outermost).clone();
        let fresh = dag.domain(Some(k), range.start, range.end);
        let by = Affine::variable(fresh);
        let mut images = vec![fresh];
        for &domain in &chain[1..] {
            let variable = dag.variable(domain);
            let moved = dag.replace(variable, outermost, &by);
            let Kind::Variable(image) = *dag.kind(moved) else {
                return None;
            };
            images.push(image);
        }
        adjoint = dag.replace(adjoint, outermost, &by);
        row = row.substitute(|d| match chain.iter().position(|other| *other == d) {
            Some(at) => Affine::variable(images[at]),
            None => Affine::variable(d),
        });
        chain = images;
    }
    let inner = chain[chain.len() - 1];
    let mut around = chain[..chain.len() - 1].to_vec();
    let range = dag.range(inner).clone();
    let (factor, rest) = row.affine.isolated(inner);
    let solved = match &row.modulo {
        // inner = ±(k − rest)
        None if factor.abs() == 1 && rest.loops.is_empty() => Some(Index::plain(
            Affine::default()
                .plus(factor, &Affine::variable(k))
                .plus(-factor, &rest),
        )),
        // A shift of all elements onto themselves.
        Some(modulo) if modulo == rows => (dag.rotation(&row, inner))
            .map(|shift| Index::wrapped(Affine::variable(k).plus(-1, &shift), modulo.clone())),
        _ => None,
    };
    let mut value = match solved {
        Some(index) if index.modulo.is_none() => {
            let at = index.affine;
            let mut value = dag.replace(adjoint, inner, &at);
            // start ≤ at < end
            let bounds = [at.plus(-1, &range.start), at.room_below(&range.end)?];
            for bound in bounds {
                if dag.is_never_negative(&bound) {
                    continue;
                }
                match tighten(dag, &bound, &mut around, value) {
                    Some(moved) => value = moved,
                    None => {
                        let (zero, holds) = (dag.integer(0), dag.at_least_zero(&bound));
                        value = dag.select(holds, value, zero);
                    }
                }
            }
            value
        }
        Some(index) => dag.reindexed(adjoint, inner, &index)?,
        None if row.modulo.is_none() => {
            let fresh = dag.domain(
                Some(around.last().copied().unwrap_or(k)),
                range.start,
                range.end,
            );
            let by = Affine::variable(fresh);
            let value = dag.replace(adjoint, inner, &by);
            let row = row.affine.substitute(|d| {
                if d == inner {
                    by.clone()
                } else {
                    Affine::variable(d)
                }
            });
            around.push(fresh);
            where_equal(dag, &row, k, value)
        }
        None => return None,
    };
    for &domain in around.iter().rev() {
        value = dag.reduce(domain, value);
    }
    Some(value)
}

/// The value at a site of an array with several axes, in loops over all of them, as an expression of the
/// number k of the element; `None` where it reads more than elements at that site: the number says no
/// index of an axis without a division.
fn at_number(dag: &mut Dag, site: &Index, loops: Loops, value: Node, k: Domain) -> Option<Node> {
    let number = Index::of_loop(k);
    let nodes = dag.reachable(&[value]);
    let new = dag.try_map(nodes, |dag, node, new| match dag.kind(node).clone() {
        _ if !dag.variables(node).meets(loops) => Some(node),
        Kind::Element(array, row, None) if row == *site => {
            Some(dag.element(array, number.clone(), None))
        }
        Kind::Element(..) | Kind::Variable(_) | Kind::Reduce(..) | Kind::Count(_) => None,
        _ => Some(dag.rebuild(node, &|child| new[&child])),
    });
    new.map(|new| new[&value])
}

/// The value where `index = k`, 0 elsewhere.
fn where_equal(dag: &mut Dag, index: &Affine, k: Domain, value: Node) -> Node {
    let (zero, k, index) = (dag.integer(0), dag.variable(k), dag.affine(index));
    let equal = dag.equal(index, k);
    dag.select(equal, value, zero)
}

/// Takes the condition `bound ≥ 0` into the range of the one loop around that it names: the value
/// over the loop so restricted.
fn tighten(dag: &mut Dag, bound: &Affine, around: &mut [Domain], value: Node) -> Option<Node> {
    let named: Vec<usize> = (0..around.len())
        .filter(|at| bound.factor(around[*at]) != 0)
        .into_list();
    let [at] = named.as_slice() else { return None };
    if at + 1 != around.len() {
        return None;
    }
    let domain = around[*at];
    let parent = dag.range(domain).parent;
    let [start, end] = dag.narrowed(domain, bound)?;
    let fresh = dag.domain(parent, start, end);
    around[*at] = fresh;
    Some(dag.replace(value, domain, &Affine::variable(fresh)))
}
