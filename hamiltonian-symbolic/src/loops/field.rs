//! The derivative with respect to element k of an array, as an expression of k.
//!
//! Input: adjoints as [`crate::diff::gradient`] leaves them, where `q[index]` in a loop means that
//! every iteration adds to that element. Output: one expression in the loop k in 0..rows: the
//! index is solved for a loop variable, the other loops become sums. Invariant: where an index
//! cannot be solved, a condition `index = k` is summed instead; where not even that can be said,
//! there is no answer.

use crate::dag::{Array, Dag, Kind, Map, Node};
use crate::index::{Affine, Domain, Index};

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
    let factor = row.affine.factor(inner);
    let rest = row.affine.plus(-factor, &Affine::variable(inner));
    let solved = match &row.modulo {
        // inner = ±(k − rest)
        None if factor.abs() == 1 && rest.loops.is_empty() => Some(Index::plain(
            Affine::default()
                .plus(factor, &Affine::variable(k))
                .plus(-factor, &rest),
        )),
        // A shift of all elements onto themselves.
        Some(modulo)
            if factor == 1
                && rest.loops.is_empty()
                && modulo == rows
                && dag.runs_over(inner, rows) =>
        {
            Some(Index::wrapped(
                Affine::variable(k).plus(-1, &rest),
                modulo.clone(),
            ))
        }
        _ => None,
    };
    let mut value = match solved {
        Some(index) if index.modulo.is_none() => {
            let at = index.affine;
            let mut value = dag.replace(adjoint, inner, &at);
            // start ≤ at < end
            let bounds = [
                at.plus(-1, &range.start),
                range.end.plus(-1, &at).plus(-1, &Affine::constant(1)),
            ];
            for bound in bounds {
                if dag.is_never_negative(&bound) {
                    continue;
                }
                match tighten(dag, &bound, &mut around, value) {
                    Some(moved) => value = moved,
                    None => {
                        let (zero, holds) = (dag.integer(0), at_least_zero(dag, &bound));
                        value = dag.select(holds, value, zero);
                    }
                }
            }
            value
        }
        Some(index) => shift(dag, adjoint, inner, &index)?,
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

/// The value where `index = k`, 0 elsewhere.
fn where_equal(dag: &mut Dag, index: &Affine, k: Domain, value: Node) -> Node {
    let (zero, k, index) = (dag.integer(0), dag.variable(k), dag.affine(index));
    let equal = dag.equal(index, k);
    dag.select(equal, value, zero)
}

/// The condition `affine ≥ 0`, negative terms on the left: `1 <= k`, `k + 2 <= N`.
pub(crate) fn at_least_zero(dag: &mut Dag, affine: &Affine) -> Node {
    let mut above = affine.clone();
    above.constant = above.constant.max(0);
    above.loops.retain(|(_, n)| *n > 0);
    above.sizes.retain(|(_, n)| *n > 0);
    let below = above.plus(-1, affine);
    let (below, above) = (dag.affine(&below), dag.affine(&above));
    dag.less_equal(below, above)
}

/// Takes the condition `bound ≥ 0` into the range of the one loop around that it names: the value
/// over the loop so restricted.
fn tighten(dag: &mut Dag, bound: &Affine, around: &mut [Domain], value: Node) -> Option<Node> {
    let named: Vec<usize> = (0..around.len())
        .filter(|at| bound.factor(around[*at]) != 0)
        .collect();
    let [at] = named.as_slice() else { return None };
    if at + 1 != around.len() {
        return None;
    }
    let domain = around[*at];
    let range = dag.range(domain).clone();
    let factor = bound.factor(domain);
    let rest = bound.plus(-factor, &Affine::variable(domain));
    let (start, end) = match factor {
        // domain ≥ −rest
        1 => (Affine::default().plus(-1, &rest), range.end.clone()),
        // domain ≤ rest
        -1 => (range.start.clone(), rest.plus(1, &Affine::constant(1))),
        _ => return None,
    };
    let narrower = [start.plus(-1, &range.start), range.end.plus(-1, &end)];
    if !narrower.iter().all(|slack| dag.is_never_negative(slack)) {
        return None;
    }
    let fresh = dag.domain(range.parent, start, end);
    around[*at] = fresh;
    Some(dag.replace(value, domain, &Affine::variable(fresh)))
}

/// The expression with a loop variable replaced by an index modulo a size; `None` where the
/// variable stands in an index or a range that cannot be shifted.
pub(crate) fn shift(dag: &mut Dag, root: Node, variable: Domain, by: &Index) -> Option<Node> {
    let Some(modulo) = &by.modulo else {
        return Some(dag.replace(root, variable, &by.affine));
    };
    let bit = 1u64 << variable.0;
    // Loops inside the variable's move along, all in one pass: one of them may be a loop of `by`.
    let inside = dag.inside(variable);
    let mut moved: Map<Domain, Domain> = Map::default();
    let mut new: Map<Node, Node> = Map::default();
    for node in dag.reachable(&[root]) {
        if dag.variables(node) & inside == 0 {
            new.insert(node, node);
            continue;
        }
        let image = match dag.kind(node).clone() {
            Kind::Element(array, row, column) => {
                let row = shift_index(dag, &row, variable, by, &mut moved)?;
                let column = match column {
                    Some(column) => Some(shift_index(dag, &column, variable, by, &mut moved)?),
                    None => None,
                };
                dag.element(array, row, column)
            }
            Kind::Variable(domain) if domain == variable => wrapped(dag, by, modulo)?,
            Kind::Variable(domain) => {
                let domain = dag.moved(domain, variable, &by.affine, &mut moved);
                dag.variable(domain)
            }
            Kind::Count(domain) | Kind::Reduce(domain, _)
                if (dag.range(domain).start.variables() | dag.range(domain).end.variables())
                    & bit
                    != 0 =>
            {
                return None;
            }
            Kind::Count(domain) => {
                let domain = dag.moved(domain, variable, &by.affine, &mut moved);
                dag.count(domain)
            }
            Kind::Reduce(domain, body) => {
                let domain = dag.moved(domain, variable, &by.affine, &mut moved);
                dag.reduce(domain, new[&body])
            }
            _ => dag.rebuild(node, &|child| new[&child]),
        };
        new.insert(node, image);
    }
    Some(new[&root])
}

/// `(variable + c) % modulo` as a real, where the loop stays in 0..modulo: it wraps around once at
/// most, if c is −1, 0 or 1, or less than a modulus that is a number.
fn wrapped(dag: &mut Dag, index: &Index, modulo: &Affine) -> Option<Node> {
    let [(variable, 1)] = index.affine.loops.as_slice() else {
        return None;
    };
    let variable = Affine::variable(*variable);
    let slack = modulo.plus(-1, &variable).plus(-1, &Affine::constant(1));
    if !(dag.is_never_negative(&variable) && dag.is_never_negative(&slack)) {
        return None;
    }
    let by = index.affine.plus(-1, &variable).as_constant()?;
    let by = match modulo.as_constant() {
        Some(modulo) if modulo > 0 => by.rem_euclid(modulo),
        Some(_) => return None,
        None if by.abs() <= 1 => by,
        None => return None,
    };
    let moved = variable.plus(1, &Affine::constant(by));
    // Elements past either end come in at the other.
    let (holds, inside, outside) = if by < 0 {
        (
            at_least_zero(dag, &moved),
            moved.clone(),
            moved.plus(1, modulo),
        )
    } else {
        let slack = modulo.plus(-1, &moved).plus(-1, &Affine::constant(1));
        (
            at_least_zero(dag, &slack),
            moved.clone(),
            moved.plus(-1, modulo),
        )
    };
    let (inside, outside) = (dag.affine(&inside), dag.affine(&outside));
    Some(dag.select(holds, inside, outside))
}

/// The index with the variable replaced; `None` unless that is modulo one size.
fn shift_index(
    dag: &mut Dag,
    index: &Index,
    variable: Domain,
    by: &Index,
    moved: &mut Map<Domain, Domain>,
) -> Option<Index> {
    let factor = index.affine.factor(variable);
    let mut rest = index.affine.plus(-factor, &Affine::variable(variable));
    for (domain, factor) in rest.loops.clone() {
        let image = dag.moved(domain, variable, &by.affine, moved);
        rest = rest
            .plus(-factor, &Affine::variable(domain))
            .plus(factor, &Affine::variable(image));
    }
    let whole = match (factor, &index.modulo) {
        (0, modulo) => {
            return Some(Index {
                affine: rest,
                modulo: modulo.clone(),
            });
        }
        (1, Some(modulo)) => Some(modulo) == by.modulo.as_ref(),
        // Without a modulus of its own the index is the variable itself.
        (1, None) => rest == Affine::default(),
        _ => false,
    };
    let modulo = by.modulo.clone()?;
    whole.then(|| plain_where_possible(dag, Index::wrapped(by.affine.plus(1, &rest), modulo)))
}

/// `i % N` for i in 0..N is `i`.
pub(crate) fn plain_where_possible(dag: &Dag, index: Index) -> Index {
    let Some(modulo) = &index.modulo else {
        return index;
    };
    match index.affine.loops.as_slice() {
        [(domain, 1)] if index.affine == Affine::variable(*domain) => {
            if dag.runs_over(*domain, modulo) {
                Index::plain(index.affine)
            } else {
                index
            }
        }
        _ => index,
    }
}
