//! The limits of the search for exact flows.
//!
//! Input: an expression. Output: whether it is large. Invariant: each limit says what it counts in. A *question* is the
//! flow of one sum of terms, or whether one expression is zero (`Space::question`). A *cover* is a choice of sums that
//! hold all terms of a group (`cover::candidates`); a group shares no degree of freedom with the others (`split::join`).
//!
//! # Example: a question of the search
//! H = (q² + 1)(p² + 1)/2 + x²y² + u²/2 has two groups: {q, p}, and {x, y, u, …}. For the first one, `cover` asks whether
//! the sum of all its terms has a flow. This is one question. It may take [`COMPARISONS`] comparisons of expressions,
//! [`PRODUCTS`] products of terms and [`EXPRESSIONS`] new nodes.
//!
//! 1. A form finds that the sum is a product of two squares and asks whether `(q² + 1)(p² + 1)/2` equals it: one comparison,
//!    which may take [`COMPARISON`] products. It takes four.
//! 2. The answer is a flow: the question ends, and what it spent counts against [`ALL_PRODUCTS`] of the group.
//! 3. If a limit had been met, the answer would be unknown, which is neither returned nor remembered: a later question about
//!    the same sum starts with a budget of its own.

use crate::dag::{Dag, Node};
use std::fmt;

// Of one question.

/// The most comparisons.
pub(crate) const COMPARISONS: usize = 400;

/// The most nodes that are added to the arena.
pub const EXPRESSIONS: usize = 6_000;

/// The most products of terms that normal forms take.
pub(crate) const PRODUCTS: usize = 60_000;

/// The most products of terms that the normal form takes for one comparison.
pub(crate) const COMPARISON: usize = 20_000;

/// The most terms of a sum that are parted into parts that commute.
pub(crate) const COMMUTING: usize = 36;

/// The most parts that commute.
pub(crate) const PARTS: usize = 9;

/// The most components of a point whose quadratic forms are exponentiated as matrices.
pub(crate) const COMPONENTS: usize = 16;

// Of all questions of a group.

/// The most products of terms that normal forms take; one question may take a tenth of them.
pub(crate) const ALL_PRODUCTS: usize = 10 * PRODUCTS;

/// The most nodes that are added to the arena; one question may add a tenth of them.
pub(crate) const ALL_EXPRESSIONS: usize = 10 * EXPRESSIONS;

// Of one cover.

/// The most terms that are combined to pieces; of more, those of coordinates alone and those of momenta alone are one
/// each.
pub(crate) const TERMS: usize = 32;

/// The most sums of terms of which a flow is sought.
pub(crate) const SUMS: usize = 64;

/// The most coupled terms all of whose sums are tried; of more only the terms, pairs of them, and all.
pub(crate) const COUPLED: usize = 5;

/// The most covers that are kept. It limits the choice alone: if there is one, the first is found.
pub(crate) const COVERS: usize = 60;

/// The most terms of a form that is multiplied out and searched beside the one that is written.
pub(crate) const REFINED: usize = 12;

// Of one group.

/// The most subexpressions of terms in which conjugate variables meet.
pub(crate) const SUBEXPRESSIONS: usize = 1000;

/// The most pairs, so that a set of variables is a word.
pub(crate) const PAIRS: usize = 32;

/// The most points of which numbers are kept.
pub(crate) const POINTS: usize = 64;

/// How many pieces more than the fewest a splitting may have to be compared with it.
pub(crate) const MORE_PIECES: usize = 2;

// Of the whole splitting.

/// The most pieces.
pub const PIECES: usize = 8;

// Of one loop.

/// The most elements of each array in the body of a loop.
pub(crate) const BODY_ROWS: usize = 4;

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
    /// The number of products of terms in the normal form for one comparison.
    Comparison,
    /// The number of new expressions for one flow.
    Expressions,
    /// The number of products of terms in the normal forms for all flows.
    AllProducts,
    /// The number of new expressions for all flows.
    AllExpressions,
    /// The number of terms of a sum that are parted into commuting parts.
    Commuting,
    /// The number of commuting parts.
    Parts,
    /// The number of coordinates and momenta of a point whose quadratic forms are exponentiated.
    Components,
    /// The number of terms of H.
    Terms,
    /// The number of sums of terms of which a flow is sought.
    Sums,
    /// The number of coupled terms all of whose sums are tried.
    Coupled,
    /// The number of subexpressions of terms in which conjugate variables meet.
    Subexpressions,
    /// The number of degrees of freedom that terms of H join.
    Pairs,
    /// The number of pieces.
    Pieces,
    /// The number of rows of arrays that the body of a loop names.
    BodyRows,
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Limit::Comparisons => write!(f, "{COMPARISONS} comparisons of expressions"),
            Limit::Products => write!(f, "{PRODUCTS} products of terms"),
            Limit::Comparison => write!(f, "{COMPARISON} products of terms for one comparison"),
            Limit::Expressions => write!(f, "{EXPRESSIONS} new expressions"),
            Limit::AllProducts => write!(f, "{ALL_PRODUCTS} products of terms for all flows"),
            Limit::AllExpressions => write!(f, "{ALL_EXPRESSIONS} new expressions for all flows"),
            Limit::Commuting => write!(f, "{COMMUTING} terms of a sum whose parts may commute"),
            Limit::Parts => write!(f, "{PARTS} parts that commute"),
            Limit::Components => write!(
                f,
                "{COMPONENTS} coordinates and momenta of which a quadratic form is exponentiated"
            ),
            Limit::Terms => write!(f, "{TERMS} terms"),
            Limit::Sums => write!(f, "{SUMS} sums of terms"),
            Limit::Coupled => write!(f, "{COUPLED} coupled terms of which all sums are tried"),
            Limit::Subexpressions => write!(
                f,
                "{SUBEXPRESSIONS} subexpressions of terms in which conjugate variables meet"
            ),
            Limit::Pairs => write!(f, "{PAIRS} coupled degrees of freedom"),
            Limit::Pieces => write!(f, "{PIECES} pieces"),
            Limit::BodyRows => write!(f, "{BODY_ROWS} rows in the body of a loop"),
        }
    }
}
