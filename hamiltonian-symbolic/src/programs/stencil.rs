//! Contributions to shifted sites, made at the site itself.
//!
//! Input: the stores of a function that adds to elements, as a reverse sweep leaves them: an iteration that
//! reads `u[(i + 1) % n][j]` adds to that element. Output: stores in which the iteration of a site also adds
//! what the neighbours' iterations would add to it, so that a site is written once. At open ends, where
//! `u[i - 1]` is read for i in 1..n, the iterations are counted by the site, i in 0..n − 1. Invariant: each
//! element receives the same terms. Only polynomials of few operations move, and conditions on them, because
//! the term of a bond is then computed at both of its ends; they have values everywhere.

use crate::dag::work;
use crate::dag::{Array, Dag, Kind, Node};
use crate::index::{Affine, Index, Loops};
use crate::program::Target;
use crate::ranges::Ranges;
use crate::schedule::Store;

/// The most operations of a term that is computed twice: fewer than a function takes.
const MAX_OPERATIONS_TWICE: u32 = 12;

/// The stores with those to shifted sites moved, where that is cheap.
pub(crate) fn at_sites(dag: &mut Dag, stores: Vec<Store>) -> Vec<Store> {
    let mut made: Vec<Store> = Vec::with_capacity(stores.len());
    for store in stores {
        let store = at_site(dag, &store).unwrap_or(store);
        let is_same = |other: &&mut Store| {
            let is_at = |s: &Store| s.add && s.column.is_none() && !s.row.variables().is_empty();
            is_at(other) && is_at(&store) && other.target == store.target && other.row == store.row
        };
        match made.iter_mut().find(is_same) {
            Some(first) => first.value = dag.add(&[first.value, store.value]),
            None => made.push(store),
        }
    }
    made
}

/// A store to a shifted site, moved to the site; `None` of another one.
fn at_site(dag: &mut Dag, store: &Store) -> Option<Store> {
    if !store.add || store.column.is_some() {
        return None;
    }
    let Target::Phase(column) = store.target else {
        return None;
    };
    let (mut shifts, mut known) = (Vec::new(), Loops::default());
    let site = store.row.try_map(&mut |axis| {
        let [(domain, 1)] = *axis.affine.loops.as_slice() else {
            return None;
        };
        // A loop that chooses two indices at once does not visit all sites.
        if known.has(domain) {
            return None;
        }
        known |= Loops::of(domain);
        let own = Affine::variable(domain);
        let shift = axis.affine.shift(domain)?;
        let back = own.plus(-1, &shift);
        match &axis.modulo {
            None if shift == Affine::default() => {}
            None => {
                shift.as_constant()?;
                shifts.push((domain, Shift::Open(shift)));
            }
            Some(modulo) if dag.runs_over(domain, modulo) => {
                shifts.push((
                    domain,
                    Shift::Periodic(Index::wrapped(back, modulo.clone())),
                ));
            }
            _ => return None,
        }
        Some(Index::of_loop(domain))
    })?;
    if shifts.is_empty() || !dag.variables(store.value).is_within(known) {
        return None;
    }
    let (mut value, mut row) = (store.value, site);
    for (at, (domain, shift)) in shifts.iter().enumerate() {
        match shift {
            Shift::Periodic(back) => value = dag.reindexed(value, *domain, back)?,
            Shift::Open(shift) => {
                let range = dag.range(*domain).clone();
                let is_inside = |bound: &Affine| bound.variables().is_empty();
                // Loops of the axes that follow would have other numbers.
                if at + 1 < shifts.len() || !(is_inside(&range.start) && is_inside(&range.end)) {
                    return None;
                }
                let [start, end] = [range.start, range.end].map(|bound| bound.plus(1, shift));
                let moved = dag.domain(range.parent, start, end);
                let back = Index::plain(Affine::variable(moved).plus(-1, shift));
                // The loops inside move too: an element at the site has their numbers.
                let site = dag.element(Array::Phase(column), row, None);
                let back_at_site = Index::plain(Affine::variable(moved));
                value = dag.reindexed(value, *domain, &back)?;
                let site = dag.reindexed(site, *domain, &back_at_site)?;
                let Kind::Element(_, moved_row, _) = dag.kind(site) else {
                    return None;
                };
                row = moved_row.clone();
            }
        }
    }
    is_cheap(dag, value).then(|| Store {
        row,
        value,
        ..store.clone()
    })
}

/// The displacement from a site to its neighbour along the axis of a loop.
enum Shift {
    /// The index that takes the place of the loop variable.
    Periodic(Index),
    /// The distance of the site from the loop variable.
    Open(Affine),
}

/// Returns true if an expression is a polynomial of few operations, or one of several by conditions on them.
fn is_cheap(dag: &Dag, value: Node) -> bool {
    let is_polynomial = |node: &Node| match dag.kind(*node) {
        Kind::Sum(..)
        | Kind::Constant(_)
        | Kind::Pi
        | Kind::Scalar(_)
        | Kind::Time
        | Kind::Coefficient
        | Kind::Element(..)
        | Kind::Extent(_)
        | Kind::Variable(_)
        | Kind::Compare(..)
        | Kind::Not(_)
        | Kind::And(..)
        | Kind::Or(..)
        | Kind::Select(..) => true,
        Kind::Product(_, factors) => factors.iter().all(|(_, n)| *n > 0),
        _ => false,
    };
    // Values that are the same at all sites are computed once.
    let varying = dag.reached(&[value], &mut |node, ahead| {
        if !dag.variables(node).is_empty() {
            dag.for_children(node, |child| ahead.add(child));
        }
    });
    let varies = |node: &Node| !dag.variables(*node).is_empty();
    varying
        .iter()
        .filter(|node| varies(node))
        .all(is_polynomial)
        && work(dag, &[value]) <= MAX_OPERATIONS_TWICE
}
