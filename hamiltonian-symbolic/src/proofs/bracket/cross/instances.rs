//! Walls at fixed indices, such as q[0] = 0 under a sum of 1/q[i]² over all i.
//!
//! Input: H, and an expression of elements at fixed indices. Output: true if it is the wall of one iteration
//! of a loop of H in which each iteration has a wall. Invariant: the iteration takes place for all sizes for which the
//! elements exist.

use super::walls::{self, At};
use crate::dag::{Dag, Dependence, Node};
use crate::facts::{Given, stem};
use crate::index::{Affine, Domain};
use crate::list::IntoList;
use crate::model::Model;
use crate::ranges::Ranges;

/// The most ways to choose iterations of the loops around an expression.
const MAX_CHOICES: usize = 64;

/// Returns true if |H| → ∞ wherever an expression outside loops tends to 0, as it does in each iteration of a loop.
pub(super) fn is_infinite(model: &mut Model, h: Node, node: Node, given: &Given) -> bool {
    if !model.dag.variables(node).is_empty() {
        return false;
    }
    let rows = rows(model, node);
    let minus = model.dag.neg(node);
    let zeros = [node, minus].map(|zero| stem(&model.dag, zero));
    let height = model.dag.height(zeros[0]);
    for of_loop in model.dag.reachable(&[h]) {
        let dag = &model.dag;
        let is_like = dag.dependence(of_loop).on(Dependence::MOVING)
            && dag.height(of_loop) == height
            && std::mem::discriminant(dag.kind(of_loop))
                == std::mem::discriminant(dag.kind(zeros[0]));
        if is_like
            && has_instance(model, of_loop, &zeros, &rows)
            && walls::is_infinite(&mut model.dag, h, of_loop, given, At::All)
        {
            return true;
        }
    }
    false
}

/// The rows of the elements of phase space in an expression.
fn rows(model: &Model, node: Node) -> Vec<Affine> {
    let mut rows: Vec<Affine> = Vec::new();
    for node in model.dag.reachable(&[node]) {
        if let Some((_, row)) = model.dag.phase_place(node)
            && !rows.contains(&row.affine)
        {
            rows.push(row.affine.clone());
        }
    }
    rows
}

/// Returns true if an expression is one of `zeros` in an iteration of the loops around it that takes place.
fn has_instance(model: &mut Model, of_loop: Node, zeros: &[Node; 2], rows: &[Affine]) -> bool {
    let loops = model.dag.path(model.dag.home(of_loop));
    let ways = rows.len().checked_pow(loops.len() as u32);
    if loops.is_empty() || !ways.is_some_and(|ways| (1..=MAX_CHOICES).contains(&ways)) {
        return false;
    }
    (0..ways.unwrap_or(0)).any(|way| {
        let mut way = way;
        let chosen: Vec<(Domain, Affine)> = loops
            .iter()
            .map(|domain| {
                let at = way % rows.len();
                way /= rows.len();
                (*domain, rows[at].clone())
            })
            .into_list();
        // From the innermost out: no loop inside moves.
        let instance = chosen.iter().rev().fold(of_loop, |node, (domain, row)| {
            model.dag.replace(node, *domain, row)
        });
        zeros.contains(&stem(&model.dag, instance)) && takes_place(&model.dag, &chosen)
    })
}

/// Returns true if an iteration takes place for all sizes for which the elements that are read are there.
fn takes_place(dag: &Dag, chosen: &[(Domain, Affine)]) -> bool {
    let value = |domain: Domain| {
        let mut all = chosen.iter();
        let found = all.find(|(other, _)| *other == domain);
        found.map_or_else(|| Affine::variable(domain), |(_, row)| row.clone())
    };
    chosen.iter().all(|(domain, row)| {
        let [start, end] = dag.bounds(*domain).map(|bound| bound.substitute(value));
        let is_there = |form: Option<Affine>| form.is_some_and(|form| dag.is_never_negative(&form));
        is_there(row.checked_plus(-1, &start)) && is_there(row.room_below(&end))
    })
}
