//! The order of straight code.
//!
//! Input: operations of a frame. Output: the same operations in an order in which equal ones follow each other. Invariant:
//! each operation reads what it read before, so the bits are the same.
//!
//! Eight that compute one value in eight iterations, from neighbours in registers, become one.
//!
//! A CPU foresees the next operation of the loop that runs them from those before, which fails in long code: a wrong guess
//! takes as long as ten operations. Terms of a sum over pairs are independent, and have the same operations.

use crate::allocate::registers;
use crate::op::{EIGHT, From, Op, Register};
use hamiltonian_symbolic::dag::Map;
use hamiltonian_symbolic::program::Value;
use std::mem::discriminant;

/// A register of numbers, class 0, or of conditions, class 1.
type Slot = (Register, usize);

/// The registers that an operation writes.
pub(crate) fn written(op: &Op, all: &[Slot]) -> Vec<Slot> {
    match *op {
        Op::SinCos(sine, cosine, _) => vec![(sine, 0), (cosine, 0)],
        Op::Select(to, ..) | Op::Number01(to, _) => vec![(to, 0)],
        // The first one of any other.
        _ => all.iter().take(1).copied().collect(),
    }
}

/// The slot that stands for the arrays that are written.
const ARRAYS: Slot = (0, 2);

/// True for operations on arrays that are written, which stay in their order.
fn is_ordered(op: &Op) -> bool {
    match op {
        Op::Load(_, from, _) | Op::LoadAt(_, from, _) => matches!(from, From::Written(_)),
        Op::Store(..) | Op::StoreAt(..) | Op::AddToQ(..) | Op::AddToP(..) => true,
        Op::AddProductToQ(..) | Op::AddProductToP(..) => true,
        Op::SubProductFromQ(..) | Op::SubProductFromP(..) => true,
        _ => false,
    }
}

/// Of each operation those that must come before it.
pub(crate) fn before(ops: &[Op]) -> Vec<Vec<usize>> {
    let mut writers: Map<Slot, usize> = Map::default();
    let mut readers: Map<Slot, Vec<usize>> = Map::default();
    let each = ops.iter().enumerate().map(|(at, op)| {
        let mut all: Vec<Slot> = Vec::new();
        registers(&mut op.clone(), &mut |register, class| {
            all.push((*register, class))
        });
        let mut written = written(op, &all);
        if is_ordered(op) {
            all.push(ARRAYS);
            written.push(ARRAYS);
        }
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

/// Operations in their new order.
pub(crate) struct Laid {
    pub(crate) ops: Vec<Op>,
    /// The first of eight equal ones that follow each other and whose results are to be neighbours.
    pub(crate) groups: Vec<usize>,
}

/// Orders operations, of which one overtakes fewer than `window` others: that bounds the number of values that are needed
/// at the same time. Eight that compute one value in eight iterations of a loop stay together.
pub(crate) fn interleave(ops: &[Op], sites: &[Option<Value>], window: usize) -> Laid {
    let before = before(ops);
    let (mut groups, mut is_grouped) = groups(ops, sites);
    let mut is_done = vec![false; ops.len()];
    let mut laid = Laid {
        ops: Vec::with_capacity(ops.len()),
        groups: Vec::new(),
    };
    let mut first = 0;
    while laid.ops.len() < ops.len() {
        while is_done[first] {
            first += 1;
        }
        let all = first..ops.len().min(first + window.max(1));
        let is_free = |at: &usize| !is_done[*at] && before[*at].iter().all(|of| is_done[*of]);
        let is_ready = |group: &Vec<usize>| group.iter().all(|at| all.contains(at) && is_free(at));
        if let Some(ready) = groups.iter().position(is_ready) {
            laid.groups.push(laid.ops.len());
            for at in groups.swap_remove(ready) {
                is_done[at] = true;
                laid.ops.push(ops[at]);
            }
            continue;
        }
        let free = all.clone().filter(|at| !is_grouped[*at] && is_free(at));
        let free: Vec<usize> = free.collect();
        let kind = |at: usize| discriminant(&ops[at]);
        let last = laid.ops.last().map(discriminant);
        let same = free.iter().find(|at| Some(kind(**at)) == last);
        // Otherwise one of the most frequent.
        let count = |at: &usize| free.iter().filter(|of| kind(**of) == kind(*at)).count();
        let next = same.or_else(|| free.iter().rev().max_by_key(|at| count(at)));
        let Some(at) = next else {
            // The first operation that is left waits for none, but for others of its group.
            let waits = groups.iter().position(|group| group.contains(&first));
            for at in waits
                .map(|group| groups.swap_remove(group))
                .iter()
                .flatten()
            {
                is_grouped[*at] = false;
            }
            continue;
        };
        is_done[*at] = true;
        laid.ops.push(ops[*at]);
    }
    laid
}

/// True for operations of which eight may be one.
fn has_eight(op: &Op) -> bool {
    use Op::{Add, Mul, MulAdd, Recip, Sqrt, Sub};
    matches!(
        op,
        Add(..) | Sub(..) | Mul(..) | MulAdd(..) | Recip(..) | Sqrt(..)
    )
}

/// Eight operations each that compute one value, and whether an operation is one of them.
fn groups(ops: &[Op], sites: &[Option<Value>]) -> (Vec<Vec<usize>>, Vec<bool>) {
    let mut groups = Vec::new();
    let mut is_one = vec![false; sites.len()];
    let mut begun: Map<Value, Vec<usize>> = Map::default();
    for (at, site) in sites.iter().enumerate() {
        let Some(site) = site.filter(|_| has_eight(&ops[at])) else {
            continue;
        };
        let group = begun.entry(site).or_default();
        group.push(at);
        if group.len() == EIGHT {
            group.iter().for_each(|at| is_one[*at] = true);
            groups.push(std::mem::take(group));
        }
    }
    (groups, is_one)
}

/// The operations, of which eight are one where all that they read and write are neighbours.
pub(crate) fn packed(ops: &[Op], groups: &[usize]) -> Vec<Op> {
    let mut packed = Vec::with_capacity(ops.len());
    let mut rest = 0;
    for first in groups {
        packed.extend_from_slice(&ops[rest..*first]);
        rest = first + EIGHT;
        let eight = &ops[*first..rest];
        match one_of(eight) {
            Some(one) => packed.push(one),
            None => packed.extend_from_slice(eight),
        }
    }
    packed.extend_from_slice(&ops[rest..]);
    packed
}

/// One operation for eight.
fn one_of(eight: &[Op]) -> Option<Op> {
    let places = |op: &Op| {
        let mut all = Vec::new();
        registers(&mut op.clone(), &mut |register, _| all.push(*register));
        all
    };
    let first = places(&eight[0]);
    let are_neighbours = (0..).zip(eight).all(|(k, op)| {
        let mut pairs = places(op).into_iter().zip(&first);
        pairs.all(|(place, first)| place == first + k)
    });
    if !are_neighbours {
        return None;
    }
    match eight[0] {
        Op::Add(to, a, b) => Some(Op::EightAdd(to, a, b)),
        Op::Sub(to, a, b) => Some(Op::EightSub(to, a, b)),
        Op::Mul(to, a, b) => Some(Op::EightMul(to, a, b)),
        Op::MulAdd(to, a, b, c) => Some(Op::EightMulAdd(to, a, b, c)),
        Op::Recip(to, a) => Some(Op::EightRecip(to, a)),
        Op::Sqrt(to, a) => Some(Op::EightSqrt(to, a)),
        _ => None,
    }
}
