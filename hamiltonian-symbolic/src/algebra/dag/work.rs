//! The cost of expressions.
//!
//! Input: expressions. Output: a number of operations. Invariant: what they share is counted once.

use super::{Dag, Kind, Node};

/// The operations of expressions, a power by squaring.
pub(crate) fn work(dag: &Dag, roots: &[Node]) -> u32 {
    let power = |n: i32| n.unsigned_abs().ilog2() + n.unsigned_abs().count_ones();
    let of = |node: &Node| match dag.kind(*node) {
        Kind::Sum(c, terms) => {
            let scaled = terms.iter().filter(|(k, _)| !k.is_unit()).count();
            (scaled + terms.len() - usize::from(c.is_zero())) as u32
        }
        Kind::Product(k, factors) => {
            let powers: u32 = factors.iter().map(|(_, n)| power(*n)).sum();
            let is_divided = factors.iter().any(|(_, n)| *n < 0);
            powers + u32::from(!k.is_unit()) + u32::from(is_divided) - 1
        }
        Kind::Call(..) | Kind::External(..) => 16,
        Kind::Reduce(..) | Kind::Select(..) | Kind::Compare(..) => 1,
        _ => 0,
    };
    dag.reachable(roots).iter().map(of).sum()
}
