//! The order of short code.
//!
//! Input: operations without loops. Output: the same operations, of which many follow the one whose result they wait for, and
//! read that without a register. Invariant: each operation reads what it read before, so the bits are the same.
//!
//! A result that goes through a register in memory waits there for three times as long as the operation takes.

use crate::allocate::{first_register, registers};
use crate::interleave::{before, written};
use crate::op::{Op, Register};
use crate::registers::FRAME;
use hamiltonian_symbolic::dag::Map;

/// The most operations that are laid like this.
pub(crate) const CHAINED: usize = 256;

/// The same operations with a register for each value, of those from the first one on that none names; as they are, if there
/// are too few. The registers below `fixed` are those of the point.
pub(crate) fn renamed(ops: &[Op], fixed: usize, first: usize) -> Vec<Op> {
    let mut next = first as Register;
    let mut images: Map<Register, Register> = Map::default();
    let each = ops.iter().map(|op| {
        let (mut op, mut all) = (*op, Vec::new());
        registers(&mut op, &mut |register, class| all.push((*register, class)));
        let writes = written(&op, &all);
        let new =
            |register: Register| writes.contains(&(register, 0)) && register as usize >= fixed;
        let mut made: Vec<(Register, Register)> = Vec::new();
        let mut at = 0;
        registers(&mut op, &mut |register, class| {
            // Registers that are written come first, but for a condition of a choice.
            let is_result = at < writes.len().max(1) && writes.get(at) == Some(&(*register, class));
            at += usize::from(class == 0);
            if is_result && new(*register) {
                made.push((*register, next));
                *register = next;
                next += 1;
            } else if let Some(image) = images.get(register).filter(|_| class == 0) {
                *register = *image;
            }
        });
        images.extend(made);
        op
    });
    let renamed = each.collect();
    match next as usize <= FRAME[0] {
        true => renamed,
        false => ops.to_vec(),
    }
}

/// The operations in an order in which as many as can be follow the one whose result they wait for.
pub(crate) fn chained(ops: &[Op]) -> Vec<Op> {
    let before = before(ops);
    let mut users = vec![Vec::new(); ops.len()];
    for (at, before) in before.iter().enumerate() {
        before.iter().for_each(|of| users[*of].push(at));
    }
    let mut heights = vec![0; ops.len()];
    for at in (0..ops.len()).rev() {
        let above = users[at].iter().map(|user| heights[*user]).max();
        heights[at] = above.map_or(1, |above: usize| above + 1);
    }
    let mut order = Order {
        ops,
        before,
        users,
        heights,
        is_done: vec![false; ops.len()],
        made: Vec::with_capacity(ops.len()),
    };
    order.lay(&(0..ops.len()).collect::<Vec<_>>());
    order.made
}

/// The operations, of which those read the result of the one before without a register that can.
pub(crate) fn forwarded(ops: &[Op]) -> Vec<Op> {
    let first = ops.iter().take(1).copied();
    let others = ops.windows(2).map(|pair| after(&pair[0], pair[1]));
    first.chain(others).collect()
}

/// The operation, as one that reads the result of the operation before it, if it reads that.
fn after(before: &Op, op: Op) -> Op {
    let Some(last) = result(before) else {
        return op;
    };
    match op {
        Op::Mul(to, a, b) if a == last && b == last => Op::LastSquare(to),
        Op::Mul(to, a, b) | Op::Mul(to, b, a) if a == last => Op::LastMul(to, b),
        Op::Add(to, a, b) | Op::Add(to, b, a) if a == last => Op::LastAdd(to, b),
        Op::Sub(to, a, b) if a == last => Op::LastSub(to, b),
        Op::Sub(to, a, b) if b == last => Op::SubLast(to, a),
        Op::MulAdd(to, a, b, c) if c == last => Op::MulAddLast(to, a, b),
        Op::MulAdd(to, a, b, c) | Op::MulAdd(to, b, a, c) if a == last => Op::LastMulAdd(to, b, c),
        Op::NegMulAdd(to, a, b, c) if c == last => Op::NegMulAddLast(to, a, b),
        Op::NegMulAdd(to, a, b, c) | Op::NegMulAdd(to, b, a, c) if a == last => {
            Op::LastNegMulAdd(to, b, c)
        }
        Op::Call(to, function, a) if a == last => Op::LastCall(to, function),
        op => op,
    }
}

/// The register of the number that an operation leaves last.
fn result(op: &Op) -> Option<Register> {
    match *op {
        Op::SinCos(_, cosine, _) => Some(cosine),
        Op::Less(..) | Op::LessEqual(..) | Op::Equal(..) | Op::IsOne(..) => None,
        Op::Not(..) | Op::And(..) | Op::Or(..) => None,
        Op::Store(..) | Op::AddToQ(..) | Op::AddToP(..) => None,
        Op::AddProductToQ(..) | Op::AddProductToP(..) => None,
        Op::SubProductFromQ(..) | Op::SubProductFromP(..) => None,
        Op::Select(to, ..) | Op::Number01(to, _) => Some(to),
        op => first_register(&op),
    }
}

/// Operations that are laid one after the other.
struct Order<'a> {
    ops: &'a [Op],
    /// Of each operation those that must come before it, and those that must come after it.
    before: Vec<Vec<usize>>,
    users: Vec<Vec<usize>>,
    /// The number of operations on the longest way to the end.
    heights: Vec<usize>,
    is_done: Vec<bool>,
    made: Vec<Op>,
}

impl Order<'_> {
    /// Lays operations, in the order of their numbers, with which all that they wait for are: the one on the longest way first,
    /// behind it the one that waits for it, and so on, and before them what those wait for besides.
    fn lay(&mut self, all: &[usize]) {
        loop {
            let free = all.iter().filter(|at| !self.is_done[**at]);
            let free = free.filter(|at| self.before[**at].iter().all(|of| self.is_done[*of]));
            // Of equal ones the first.
            let Some(first) = free.rev().max_by_key(|at| self.heights[**at]) else {
                return;
            };
            let mut chain = vec![*first];
            let mut beside = Vec::new();
            while let Some((next, others)) = self.next(&chain, all) {
                chain.push(next);
                beside.extend(others);
            }
            beside.sort_unstable();
            beside.dedup();
            self.lay(&beside);
            for at in chain {
                self.is_done[at] = true;
                self.made.push(self.ops[at]);
            }
        }
    }

    /// The one of `all` on the longest way that reads the result of the last one of a chain, if it waits for the others of the
    /// chain through that alone, with what it waits for besides.
    fn next(&self, chain: &[usize], all: &[usize]) -> Option<(usize, Vec<usize>)> {
        let last = *chain.last()?;
        let reads = |at: &&usize| after(&self.ops[last], self.ops[**at]) != self.ops[**at];
        let is_one = |at: &&usize| all.binary_search(at).is_ok();
        let users = self.users[last].iter().filter(is_one).filter(reads);
        let next = *users.max_by_key(|at| self.heights[**at])?;
        let mut beside: Vec<usize> = Vec::new();
        let mut left = self.before[next].clone();
        left.retain(|at| *at != last);
        while let Some(at) = left.pop() {
            if self.is_done[at] || beside.contains(&at) {
                continue;
            }
            if chain.contains(&at) {
                return None;
            }
            beside.push(at);
            left.extend(&self.before[at]);
        }
        Some((next, beside))
    }
}
