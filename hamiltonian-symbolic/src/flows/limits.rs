//! The limits of the search for exact flows.
//!
//! Each group of terms of H that has no degree of freedom in common with the others is searched by itself
//! (`split::join`), and each question in it has limits of its own: the flow of one sum of terms, or whether one
//! expression is zero.

use crate::dag::{Dag, Node};
use std::fmt;

/// The most comparisons for one flow; those of the systems in the tests take 18 at most.
pub(crate) const TESTS: usize = 400;

/// The most nodes that the search for one flow adds to the arena; those of the systems in the tests stay below 1500.
pub const NODES: usize = 6_000;

/// The most products of terms that the normal form takes for one flow.
pub(crate) const PRODUCTS: usize = 60_000;

/// The most products of terms that the normal form takes for one comparison.
pub(crate) const COMPARISON: usize = 20_000;

/// The most points of which numbers are kept.
pub(crate) const POINTS: usize = 64;

/// The most terms of H that are combined to pieces; of more, those of coordinates alone and those of momenta alone are
/// one each.
pub(crate) const TERMS: usize = 32;

/// The most pieces of a splitting.
pub const MOST: usize = 8;

/// The most terms of a sum that are parted into parts that commute,
pub(crate) const COMMUTING: usize = 36;
/// and the most such parts.
pub(crate) const PARTS: usize = 9;

/// The most sums of terms of which a flow is sought.
pub(crate) const SUMS: usize = 64;
/// The most coupled terms all of whose sums are tried; of more only the terms, pairs of them, and all.
pub(crate) const COUPLED: usize = 5;

/// The most elements of each array in the body of a loop.
pub(crate) const ROWS: usize = 4;

/// The most components of a point whose quadratic forms are exponentiated as matrices.
pub(crate) const COMPONENTS: usize = 16;

/// The most subexpressions of terms in which coordinates and momenta meet.
pub(crate) const SUBEXPRESSIONS: usize = 1000;

/// The most pairs, so that a set of variables is a word.
pub(crate) const PAIRS: usize = 32;

/// Returns true if an expression has more subexpressions than are searched.
pub(crate) fn is_large(dag: &Dag, node: Node) -> bool {
    dag.reachable(&[node]).len() > SUBEXPRESSIONS
}

/// A limit at which the search for exact flows ends.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Limit {
    /// The number of comparisons of two expressions for one flow.
    Comparisons,
    /// The number of products of terms in the normal forms for one flow.
    Products,
    /// The number of new expressions for one flow.
    Expressions,
    /// The number of terms of H.
    Terms,
    /// The number of subexpressions of terms in which coordinates and momenta meet.
    Subexpressions,
    /// The number of degrees of freedom that terms of H join.
    Pairs,
    /// The number of pieces.
    Pieces,
    /// The number of terms of a sum that are parted into commuting parts.
    Commuting,
    /// The number of commuting parts.
    Parts,
    /// The number of sums of terms of which a flow is sought.
    Sums,
    /// The number of coupled terms all of whose sums are tried.
    Coupled,
    /// The number of rows of arrays that the body of a loop names.
    Rows,
    /// The number of products of terms in the normal form for one comparison.
    Comparison,
    /// The number of coordinates and momenta of a point whose quadratic forms are exponentiated.
    Components,
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Limit::Comparisons => write!(f, "{TESTS} comparisons of expressions"),
            Limit::Products => write!(f, "{PRODUCTS} products of terms"),
            Limit::Expressions => write!(f, "{NODES} new expressions"),
            Limit::Terms => write!(f, "{TERMS} terms"),
            Limit::Subexpressions => write!(
                f,
                "{SUBEXPRESSIONS} subexpressions of terms in which coordinates and momenta meet"
            ),
            Limit::Pairs => write!(f, "{PAIRS} coupled degrees of freedom"),
            Limit::Pieces => write!(f, "{MOST} pieces"),
            Limit::Commuting => write!(f, "{COMMUTING} terms of a sum whose parts may commute"),
            Limit::Parts => write!(f, "{PARTS} parts that commute"),
            Limit::Sums => write!(f, "{SUMS} sums of terms"),
            Limit::Coupled => write!(f, "{COUPLED} coupled terms of which all sums are tried"),
            Limit::Rows => write!(f, "{ROWS} rows in the body of a loop"),
            Limit::Components => write!(
                f,
                "{COMPONENTS} coordinates and momenta of which a quadratic form is exponentiated"
            ),
            Limit::Comparison => write!(f, "{COMPARISON} products of terms for one comparison"),
        }
    }
}
