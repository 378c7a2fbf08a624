//! Contributions to shifted sites of a periodic lattice, made at the site itself.
//!
//! Input: the stores of a function that adds to elements, as a reverse sweep leaves them: an iteration that
//! reads `u[(i + 1) % n][j]` adds to that element. Output: stores in which the iteration of a site also adds
//! what the neighbours' iterations would add to it, so that rows of a lattice are written once. Invariant:
//! each element receives the same terms. Only polynomials of few operations move, because the term of a
//! bond is then computed at both of its ends; they have values everywhere.

use crate::dag::work;
use crate::dag::{Dag, Kind, Node};
use crate::index::{Affine, Index, Loops};
use crate::schedule::Store;

/// The most operations of a term that is computed twice: fewer than a function takes.
const MOST: u32 = 12;

/// The stores with those to shifted sites moved, where that is cheap.
pub(crate) fn at_sites(dag: &mut Dag, stores: Vec<Store>) -> Vec<Store> {
    let mut made: Vec<Store> = Vec::with_capacity(stores.len());
    for store in stores {
        let store = at_site(dag, &store).unwrap_or(store);
        let is_same = |other: &&mut Store| {
            let is_at = |s: &Store| s.add && s.column.is_none() && s.row.outer.is_some();
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
    if !store.add || store.column.is_some() || store.row.outer.is_none() {
        return None;
    }
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
        let own = Index::of_loop(domain);
        let shift = axis.affine.plus(-1, &own.affine);
        match &axis.modulo {
            None if shift == Affine::default() => {}
            Some(modulo) if dag.runs_over(domain, modulo) => {
                let back = own.affine.plus(-1, &shift);
                shifts.push((domain, Index::wrapped(back, modulo.clone())));
            }
            _ => return None,
        }
        Some(own)
    })?;
    if shifts.is_empty() || !dag.variables(store.value).is_within(known) {
        return None;
    }
    let mut value = store.value;
    for (domain, back) in &shifts {
        value = dag.reindexed(value, *domain, back)?;
    }
    is_cheap(dag, value).then(|| Store {
        row: site,
        value,
        ..store.clone()
    })
}

/// Returns true if an expression is a polynomial of few operations.
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
        | Kind::Variable(_) => true,
        Kind::Product(_, factors) => factors.iter().all(|(_, n)| *n > 0),
        _ => false,
    };
    // Values that are the same at all sites are computed once.
    let varying = dag.reached(&[value], |node, ahead| {
        if !dag.variables(node).is_empty() {
            dag.for_children(node, |child| ahead.add(child));
        }
    });
    let varies = |node: &Node| !dag.variables(*node).is_empty();
    varying
        .iter()
        .filter(|node| varies(node))
        .all(is_polynomial)
        && work(dag, &[value]) <= MOST
}
