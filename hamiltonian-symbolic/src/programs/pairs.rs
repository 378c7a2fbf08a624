//! Sums over pairs that can be computed tile by tile.
//!
//! Input: an outermost loop of a function whose inputs and outputs are different vectors. Output: [`Pairs`], if
//! iteration i changes elements i and, for each j of a triangle, elements j alone. Invariant: what is stored is
//! linear in the sums over j, so that each tile of rows and columns adds its part of them by itself.

use crate::index::{Affine, Domain, Index};
use crate::program::{Instruction, Loop, Program, Step, Target, Update, Value};

/// The least number of rows of a triangle that is computed in tiles, on one thread as on several: the order of a
/// sum depends on the number of its terms alone.
pub const LEAST: usize = 4096;

/// The number of rows, and of columns, of a tile.
pub const TILE: usize = 512;

/// The columns that a row of a triangle has.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Triangle {
    /// Those before it: `j in 0..i`.
    Below,
    /// Those after it: `j in i + 1..n`.
    Above,
}

/// A loop over the pairs of a triangle.
#[derive(Debug)]
pub struct Pairs<'a> {
    /// The loop over the columns of a row.
    pub inner: &'a Loop,
    /// The columns of a row.
    pub triangle: Triangle,
    /// The outputs that are stored to.
    pub targets: Vec<Target>,
    /// The positions in the outer loop's body of the stores that read no sum: each row makes them once.
    pub once: Vec<usize>,
}

/// Reads a loop as a loop over pairs; `None` if it is something else.
#[must_use]
pub fn pairs<'a>(outer: &'a Loop, program: &Program) -> Option<Pairs<'a>> {
    let is_whole = outer.start.as_constant() == Some(0) && outer.end.loops.is_empty();
    if !is_whole || !outer.accumulators.is_empty() {
        return None;
    }
    let mut found = None;
    let (mut stores, mut once) = (Vec::new(), Vec::new());
    let mut sums: Vec<Value> = Vec::new();
    for (at, step) in outer.body.iter().enumerate() {
        match step {
            Step::Let(value) => {
                if is_linear(program.instruction(*value), &sums)? {
                    sums.push(*value);
                }
            }
            Step::Loop(inner) if found.is_none() => {
                found = Some((inner, triangle(outer, inner)?));
                columns(inner, &mut stores)?;
                sums.clone_from(&inner.accumulators);
            }
            Step::Loop(_) | Step::Accumulate(..) => return None,
            Step::Store(..) => {
                let update = store(step, outer.domain, &mut stores)?;
                if !is_linear_update(update, &sums)? {
                    once.push(at);
                }
            }
        }
    }
    let mut targets = Vec::new();
    for (target, _) in &stores {
        if !targets.contains(target) {
            targets.push(*target);
        }
    }
    // Nothing is added to an element that is overwritten.
    let is_alone = |target| stores.iter().filter(|(other, _)| *other == target).count() == 1;
    let is_lost = |(target, adds): &(Target, bool)| !adds && !is_alone(*target);
    let (inner, triangle) = found.filter(|_| !stores.iter().any(is_lost))?;
    Some(Pairs {
        inner,
        triangle,
        targets,
        once,
    })
}

/// The triangle that the range of the inner loop makes.
fn triangle(outer: &Loop, inner: &Loop) -> Option<Triangle> {
    let row = Affine::variable(outer.domain);
    if inner.start.as_constant() == Some(0) && inner.end == row {
        return Some(Triangle::Below);
    }
    let is_above = inner.start == Affine::constant(1).plus(1, &row) && inner.end == outer.end;
    is_above.then_some(Triangle::Above)
}

/// Notes the stores of an innermost loop, each of which adds to the element of the loop's own variable. `None` if
/// any is another, or if a sum goes beyond the loop.
fn columns(inner: &Loop, stores: &mut Vec<(Target, bool)>) -> Option<()> {
    for step in &inner.body {
        match step {
            Step::Let(_) => {}
            Step::Accumulate(to, _) if inner.accumulators.contains(to) => {}
            Step::Store(..) => {
                if matches!(store(step, inner.domain, stores)?, Update::Set(_)) {
                    return None;
                }
            }
            Step::Accumulate(..) | Step::Loop(_) => return None,
        }
    }
    Some(())
}

/// Notes the output that a store changes, and whether it adds. `None` if its element is not that of the loop's
/// variable.
fn store<'a>(
    step: &'a Step,
    domain: Domain,
    stores: &mut Vec<(Target, bool)>,
) -> Option<&'a Update> {
    let Step::Store(target @ Target::Phase(_), row, None, update) = step else {
        return None;
    };
    stores.push((*target, !matches!(update, Update::Set(_))));
    (*row == Index::plain(Affine::variable(domain))).then_some(update)
}

/// Returns true if a value is linear in sums and false if it reads none; `None` if it is something else.
fn is_linear(instruction: &Instruction, sums: &[Value]) -> Option<bool> {
    let of = |value: &Value| sums.contains(value);
    let product = |a: &Value, b: &Value| match (of(a), of(b)) {
        (true, true) => None,
        (a, b) => Some(a || b),
    };
    let same = |a: bool, b: bool| (a == b).then_some(a);
    match instruction {
        Instruction::Neg(a) => Some(of(a)),
        Instruction::Add(a, b) | Instruction::Sub(a, b) => same(of(a), of(b)),
        Instruction::Mul(a, b) => product(a, b),
        Instruction::MulAdd(a, b, c)
        | Instruction::MulSub(a, b, c)
        | Instruction::NegMulAdd(a, b, c) => same(product(a, b)?, of(c)),
        Instruction::Div(a, b) if !of(b) => Some(of(a)),
        other => {
            let mut reads = false;
            other.for_operands(|operand| reads |= of(&operand));
            (!reads).then_some(false)
        }
    }
}

/// The same for what a store adds.
fn is_linear_update(update: &Update, sums: &[Value]) -> Option<bool> {
    match update {
        Update::Add(a) | Update::Sub(a) => Some(sums.contains(a)),
        Update::AddProduct(a, b) | Update::SubProduct(a, b) => {
            is_linear(&Instruction::Mul(*a, *b), sums)
        }
        Update::Set(a) => (!sums.contains(a)).then_some(false),
    }
}
