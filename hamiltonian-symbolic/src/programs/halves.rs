//! Functions that are the composition of two others.
//!
//! Input: a function of the whole H and the functions of its halves. Output: true if the two halves compute the same
//! operations as the whole, and no more. Invariant: only straight-line code is compared, since a loop of the whole may
//! serve both halves at once.

use crate::dag::Map;
use crate::program::{Function, Instruction, Program, Purpose, Step, Update, Value};

/// The limit of steps to be compared.
const MAX_STEPS: usize = 400;

/// Returns true if the function `whole` is that of one half followed by that of the other, without shared work.
pub fn are_apart(program: &Program, whole: Purpose, halves: [Purpose; 2]) -> bool {
    let halves = halves.map(|purpose| program.function(purpose));
    let (Some(whole), [Some(a), Some(b)]) = (program.function(whole), halves) else {
        return false;
    };
    let evaluations = [whole, a, b].map(|function| &function.evaluation);
    let is_plain = |step: &Step| matches!(step, Step::Let(_) | Step::Store(..));
    let is_let = |step: &&Step| match step {
        Step::Let(value) => !program.instruction(*value).is_number(),
        _ => false,
    };
    let [all, first, second] = evaluations.map(|steps| steps.iter().filter(is_let).count());
    evaluations[0].len() <= MAX_STEPS
        && all == first + second
        && evaluations.into_iter().flatten().all(is_plain)
        && [a, b].iter().all(|half| has_stores(program, whole, half))
        && stores(whole) == stores(a) + stores(b)
        && whole.cleared.len() == a.cleared.len() + b.cleared.len()
}

fn stores(function: &Function) -> usize {
    let is_store = |step: &&Step| matches!(step, Step::Store(..));
    function.evaluation.iter().filter(is_store).count()
}

/// Returns true if each store of a half, and each output that it clears, occurs in the whole.
fn has_stores(program: &Program, whole: &Function, half: &Function) -> bool {
    let mut known = Map::default();
    let mut is_there = |step: &Step| {
        let Step::Store(target, row, column, update) = step else {
            return true;
        };
        whole.evaluation.iter().any(|other| match other {
            Step::Store(to, at, of, by) if (to, at, of) == (target, row, column) => {
                is_same_update(program, update, by, &mut known)
            }
            _ => false,
        })
    };
    half.evaluation.iter().all(&mut is_there)
        && half
            .cleared
            .iter()
            .all(|target| whole.cleared.contains(target))
}

/// Pairs of values already compared.
type Compared = Map<(Value, Value), bool>;

fn is_same_update(program: &Program, a: &Update, b: &Update, known: &mut Compared) -> bool {
    let values = |update: &Update| {
        let mut values = Vec::new();
        update.for_operands(|value| values.push(value));
        values
    };
    core::mem::discriminant(a) == core::mem::discriminant(b)
        && are_same(program, &values(a), &values(b), known)
}

fn are_same(program: &Program, a: &[Value], b: &[Value], known: &mut Compared) -> bool {
    a.len() == b.len() && (a.iter().zip(b)).all(|(a, b)| is_same(program, *a, *b, known))
}

/// Returns true if the same operations on the same inputs compute both values.
fn is_same(program: &Program, a: Value, b: Value, known: &mut Compared) -> bool {
    if a == b {
        return true;
    }
    if let Some(same) = known.get(&(a, b)) {
        return *same;
    }
    let [x, y] = [a, b].map(|value| program.instruction(value));
    let operands = [x, y].map(|instruction| {
        let mut values = Vec::new();
        instruction.for_operands(|value| values.push(value));
        values
    });
    let same = match (x, y) {
        (Instruction::Call(f, _), Instruction::Call(g, _)) => f == g,
        (Instruction::External(f, part, _), Instruction::External(g, other, _)) => {
            (f, part) == (g, other)
        }
        (Instruction::Compare(f, ..), Instruction::Compare(g, ..)) => f == g,
        _ if operands[0].is_empty() => x == y,
        _ => core::mem::discriminant(x) == core::mem::discriminant(y),
    };
    let same = same && are_same(program, &operands[0], &operands[1], known);
    known.insert((a, b), same);
    same
}
