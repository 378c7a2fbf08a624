//! Loops that read a replaced coordinate, taken apart as far as its chart needs.
//!
//! Input: a model, roots, and which groups are replaced. Output: the roots, in which elements of
//! groups with a map of their own for each row stand at literal rows, and of bodies in loops that
//! begin at row 1 wherever that can be said. Invariant: values are the same for every size that
//! leaves a group of bodies at least one row; other sizes may be 0.

use super::NoTransform;
use super::bodies::{SizedBodies, least};
use super::layout::coordinate;
use crate::dag::{Dag, Kind, Node};
use crate::index::{Affine, Domain, Index};
use crate::list::IntoList;
use crate::model::Model;

/// The most nodes that loops are unrolled to.
const LARGEST: usize = 1 << 20;

/// The next change of a loop.
enum Change {
    /// Unrolled.
    Unroll(i64, i64),
    /// Its first iteration taken out.
    Peel,
}

/// The roots with the loops peeled. `written` are the groups that are replaced row by row.
///
/// # Errors
/// [`NoTransform::Loops`]
pub(super) fn peel(
    model: &mut Model,
    roots: &[Node],
    written: &[u16],
    bodies: &[SizedBodies],
) -> Result<Vec<Node>, NoTransform> {
    let mut roots = roots.to_vec();
    while let Some((node, step)) = candidate(&model.dag, &roots, written, bodies) {
        let dag = &mut model.dag;
        let Kind::Reduce(domain, body) = *dag.kind(node) else {
            break;
        };
        let peeled = match step {
            Change::Unroll(start, end) => {
                let each: Vec<Node> = (start..end)
                    .map(|at| dag.replace(body, domain, &Affine::constant(at)))
                    .into_list();
                dag.add(&each)
            }
            Change::Peel => {
                let range = dag.range(domain).clone();
                let first = dag.replace(body, domain, &range.start);
                let rest = range.start.plus(1, &Affine::constant(1));
                let rest = dag.domain(range.parent, rest, range.end);
                let body = dag.replace(body, domain, &Affine::variable(rest));
                let rest = dag.reduce(rest, body);
                dag.add(&[first, rest])
            }
        };
        if dag.has_too_many_loops() {
            return Err(NoTransform::TooManyLoops);
        }
        if dag.len() > LARGEST {
            let group = written.first().copied().or(bodies.first().map(|b| b.old));
            return Err(NoTransform::Loops {
                coordinate: coordinate(model, group.unwrap_or(0)),
                reason: "it is too long".to_owned(),
            });
        }
        for root in &mut roots {
            let replace = |_: &mut Dag, other: Node| (other == node).then_some(peeled);
            *root = dag.substitute(*root, replace);
        }
    }
    for node in model.dag.reachable(&roots) {
        if let Some((group, row)) = read(&model.dag, node)
            && written.contains(&group)
            && row.as_constant().is_none()
        {
            return Err(NoTransform::Loops {
                coordinate: coordinate(model, group),
                reason: "its length is not a literal".to_owned(),
            });
        }
    }
    Ok(roots)
}

/// The group and the row of an element of phase space.
fn read(dag: &Dag, node: Node) -> Option<(u16, &Index)> {
    dag.phase_place(node)
        .map(|(column, row)| (column.group, row))
}

/// The next loop to peel, the outermost first: loops inside it may be peeled after it.
fn candidate(
    dag: &Dag,
    roots: &[Node],
    written: &[u16],
    bodies: &[SizedBodies],
) -> Option<(Node, Change)> {
    let mut found: Option<(usize, Node, Change)> = None;
    for node in dag.reachable(roots) {
        let Kind::Reduce(domain, body) = *dag.kind(node) else {
            continue;
        };
        let depth = dag.depth(Some(domain));
        if found.as_ref().is_some_and(|(known, ..)| *known <= depth) {
            continue;
        }
        if let Some(step) = step(dag, domain, body, written, bodies) {
            found = Some((depth, node, step));
        }
    }
    found.map(|(_, node, step)| (node, step))
}

fn step(
    dag: &Dag,
    domain: Domain,
    body: Node,
    written: &[u16],
    bodies: &[SizedBodies],
) -> Option<Change> {
    let range = dag.range(domain);
    let literal = range.start.as_constant().zip(range.end.as_constant());
    let start = range.start.as_constant();
    // True if there is a first iteration.
    let runs = start
        .zip(least(dag, &range.end, bodies))
        .is_some_and(|(start, end)| start < end);
    for node in dag.reachable(&[body]) {
        let Some((group, row)) = read(dag, node) else {
            continue;
        };
        if !row.variables().has(domain) {
            continue;
        }
        if written.contains(&group)
            && let Some((start, end)) = literal
        {
            return Some(Change::Unroll(start, end));
        }
        let is_body = bodies.iter().any(|bodies| bodies.old == group);
        if is_body
            && runs
            && row.modulo.is_none()
            && row.outer.is_none()
            && row.affine.factor(domain) > 0
            && least(dag, &row.affine, bodies) == Some(0)
        {
            return Some(Change::Peel);
        }
    }
    None
}
