//! The order of straight code.
//!
//! Input: operations of a frame. Output: the same operations in an order in which equal ones follow each other. Invariant:
//! each operation reads what it read before, so the bits are the same.
//!
//! A CPU foresees the next operation of the loop that runs them from those before, which fails in long code: a wrong guess
//! takes as long as ten operations. Terms of a sum over pairs are independent, and have the same operations.

use crate::allocate::registers;
use crate::op::{Op, Register};
use hamiltonian_symbolic::dag::Map;
use std::mem::discriminant;

/// A register of numbers, class 0, or of conditions, class 1.
type Slot = (Register, usize);

/// The registers that an operation writes.
fn written(op: &Op, all: &[Slot]) -> Vec<Slot> {
    match *op {
        Op::SinCos(sine, cosine, _) => vec![(sine, 0), (cosine, 0)],
        Op::Select(to, ..) | Op::Number01(to, _) => vec![(to, 0)],
        // The first one of any other.
        _ => all.iter().take(1).copied().collect(),
    }
}

/// Of each operation those that must come before it.
fn before(ops: &[Op]) -> Vec<Vec<usize>> {
    let mut writers: Map<Slot, usize> = Map::default();
    let mut readers: Map<Slot, Vec<usize>> = Map::default();
    let each = ops.iter().enumerate().map(|(at, op)| {
        let mut all: Vec<Slot> = Vec::new();
        registers(&mut op.clone(), &mut |register, class| {
            all.push((*register, class))
        });
        let written = written(op, &all);
        let mut before = Vec::new();
        // A written register counts as read: a change of an element reads it.
        for place in all {
            before.extend(writers.get(&place));
            readers.entry(place).or_default().push(at);
        }
        for place in written {
            if let Some(earlier) = readers.get_mut(&place) {
                before.extend(earlier.drain(..).filter(|earlier| *earlier != at));
            }
            writers.insert(place, at);
        }
        before.sort_unstable();
        before.dedup();
        before
    });
    each.collect()
}

/// Orders operations, of which one overtakes fewer than `window` others: that bounds the number of values that are needed
/// at the same time.
pub(crate) fn interleave(ops: &[Op], window: usize) -> Vec<Op> {
    let before = before(ops);
    let mut is_done = vec![false; ops.len()];
    let mut order: Vec<Op> = Vec::with_capacity(ops.len());
    let mut first = 0;
    while order.len() < ops.len() {
        while is_done[first] {
            first += 1;
        }
        let all = first..ops.len().min(first + window.max(1));
        let is_free = |at: &usize| !is_done[*at] && before[*at].iter().all(|of| is_done[*of]);
        let free: Vec<usize> = all.filter(is_free).collect();
        let kind = |at: usize| discriminant(&ops[at]);
        let last = order.last().map(discriminant);
        let same = free.iter().find(|at| Some(kind(**at)) == last);
        // Otherwise one of the most frequent.
        let count = |at: &usize| free.iter().filter(|of| kind(**of) == kind(*at)).count();
        let next = same.or_else(|| free.iter().rev().max_by_key(|at| count(at)));
        // The first operation that is left waits for none.
        let at = next.copied().unwrap_or(first);
        is_done[at] = true;
        order.push(ops[at]);
    }
    order
}
