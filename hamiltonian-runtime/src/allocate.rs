//! Few registers for many values.
//!
//! Input: a [`Stage`] with a register for each value. Output: the same code, in which values that are not needed at the
//! same time share registers. Invariant: a value that a loop reads and that is computed before it keeps its register to
//! the end of the loop.

use crate::op::{COEFFICIENT, EIGHT, HELD, Op, PHASE, Register, Stage};
use hamiltonian_symbolic::dag::Map;

/// The first and the last operation that needs a register.
type Span = (usize, usize);

/// The first register of each kind.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Layout {
    pub(crate) held: usize,
    pub(crate) coefficients: usize,
    /// That of the point.
    pub(crate) phase: usize,
    /// That of values.
    pub(crate) values: usize,
}

impl Layout {
    /// Held registers first, then those of the step coefficient, then values.
    pub(crate) fn of(stage: &Stage) -> Layout {
        let held = stage.held.len();
        Layout {
            held: 0,
            coefficients: held,
            phase: 0,
            values: held + stage.coefficients,
        }
    }
}

/// Numbers the registers of a stage anew. The results of eight operations from each of `groups` on are neighbours.
pub(crate) fn allocate(stage: &mut Stage, layout: Layout, groups: &[usize]) {
    let first = layout.values as Register;
    let mut spans: [Map<Register, Span>; 2] = [Map::default(), Map::default()];
    for (at, op) in stage.ops.iter().enumerate() {
        let mut op = *op;
        registers(&mut op, &mut |register, class| {
            note(&mut spans[class], *register, at);
        });
        if let Op::SinCos(sine, cosine, _) = op {
            // Also if one of them is not needed, the other has another register.
            note(&mut spans[0], sine, at + 1);
            note(&mut spans[0], cosine, at + 1);
        }
        if let Op::Loop(number) | Op::End(number) = op {
            let of = &stage.loops[number as usize];
            let sums = of.zero.iter().chain(of.trees.iter().map(|(sum, _)| sum));
            sums.for_each(|sum| note(&mut spans[0], *sum, at));
            for (_, partial) in &of.trees {
                (0..8).for_each(|k| note(&mut spans[0], partial + k, at));
            }
        }
    }
    let end = stage.ops.len();
    for result in &stage.results {
        note(&mut spans[0], *result, end);
    }
    // The partial sums of a loop are neighbours.
    let mut partials: Vec<Register> = Vec::new();
    for of in &stage.loops {
        partials.extend(of.trees.iter().map(|(_, partial)| *partial));
    }
    let loops: Vec<Span> = stage
        .loops
        .iter()
        .map(|of| (of.body - 1, of.after - 1))
        .collect();
    let mut images: [Map<Register, Register>; 2] = [Map::default(), Map::default()];
    let mut counts = [first, 0];
    for class in 0..2 {
        let is_partial = |register: Register| {
            class == 0 && partials.iter().any(|p| (*p..p + 8).contains(&register))
        };
        let mut order: Vec<(Span, Register)> = (spans[class].iter())
            .filter(|(register, _)| **register < HELD && !is_partial(**register))
            .map(|(register, span)| (extended(*span, &loops), *register))
            .collect();
        order.sort_unstable();
        let mut busy: Vec<(usize, Register)> = Vec::new();
        let mut free: Vec<Register> = Vec::new();
        for ((from, to), register) in order {
            if images[class].contains_key(&register) {
                continue;
            }
            busy.retain(|(last, image)| {
                let is_busy = *last > from;
                if !is_busy {
                    free.push(*image);
                }
                is_busy
            });
            if class == 0 && groups.binary_search(&from).is_ok() {
                let first = neighbours(&mut free, &mut counts[0]);
                let results = stage.ops[from..from + EIGHT]
                    .iter()
                    .filter_map(first_register);
                for (image, result) in (first..).zip(results) {
                    busy.push((spans[0][&result].1, image));
                    images[0].insert(result, image);
                }
                continue;
            }
            let image = free.pop().unwrap_or_else(|| {
                counts[class] += 1;
                counts[class] - 1
            });
            busy.push((to, image));
            images[class].insert(register, image);
        }
    }
    for partial in &partials {
        for k in 0..8 {
            images[0].insert(partial + k, counts[0] + k);
        }
        counts[0] += 8;
    }
    let image = |register: &mut Register, class: usize| {
        *register = match *register {
            phase if phase >= PHASE => layout.phase as Register + phase - PHASE,
            coefficient if coefficient >= COEFFICIENT => {
                layout.coefficients as Register + coefficient - COEFFICIENT
            }
            held if held >= HELD => layout.held as Register + held - HELD,
            register => images[class][&register],
        };
    };
    for op in &mut stage.ops {
        registers(op, &mut |register, class| image(register, class));
    }
    for of in &mut stage.loops {
        of.zero.iter_mut().for_each(|sum| image(sum, 0));
        for (sum, partial) in &mut of.trees {
            image(sum, 0);
            image(partial, 0);
        }
    }
    stage.results.iter_mut().for_each(|result| image(result, 0));
    stage.registers = counts[0] as usize;
    stage.masks = counts[1] as usize;
}

/// The first register of an operation: that of its result, if it has one and no condition.
pub(crate) fn first_register(op: &Op) -> Option<Register> {
    let mut first = None;
    registers(&mut op.clone(), &mut |register, _| {
        first.get_or_insert(*register);
    });
    first
}

/// The first of eight free registers.
fn neighbours(free: &mut Vec<Register>, count: &mut Register) -> Register {
    free.sort_unstable();
    let few = EIGHT as Register;
    let run = free
        .windows(EIGHT)
        .find(|run| run[EIGHT - 1] == run[0] + few - 1);
    let first = match run {
        Some(run) => run[0],
        None => {
            *count += few;
            return *count - few;
        }
    };
    free.retain(|register| !(first..first + few).contains(register));
    first
}

fn note(spans: &mut Map<Register, Span>, register: Register, at: usize) {
    let span = spans.entry(register).or_insert((at, at));
    *span = (span.0.min(at), span.1.max(at));
}

/// The span of a value with the loops around its uses that it was computed before.
fn extended((from, mut to): Span, loops: &[Span]) -> Span {
    loop {
        let around = |(start, end): &&Span| from <= *start && *start < to && to < *end;
        match loops.iter().filter(around).map(|(_, end)| *end).max() {
            Some(end) => to = end,
            None => return (from, to),
        }
    }
}

/// Visits the registers of an operation: of numbers in class 0, of conditions in class 1.
pub(crate) fn registers(op: &mut Op, visit: &mut impl FnMut(&mut Register, usize)) {
    match op {
        Op::Time(a)
        | Op::Coefficient(a)
        | Op::Number(a, _)
        | Op::Count(a, ..)
        | Op::Load(a, ..)
        | Op::LoadQ(a, _)
        | Op::LoadP(a, _)
        | Op::AddToQ(_, a)
        | Op::AddToP(_, a)
        | Op::LoadAt(a, ..) => visit(a, 0),
        Op::LastSquare(a) | Op::LastCall(a, _) => visit(a, 0),
        Op::Copy(a, b)
        | Op::Neg(a, b)
        | Op::Recip(a, b)
        | Op::Sqrt(a, b)
        | Op::Call(a, _, b)
        | Op::LastAdd(a, b)
        | Op::LastSub(a, b)
        | Op::SubLast(a, b)
        | Op::LastMul(a, b)
        | Op::EightRecip(a, b)
        | Op::EightSqrt(a, b) => {
            [a, b].into_iter().for_each(|r| visit(r, 0));
        }
        Op::Add(a, b, c)
        | Op::Sub(a, b, c)
        | Op::Mul(a, b, c)
        | Op::EightAdd(a, b, c)
        | Op::EightSub(a, b, c)
        | Op::EightMul(a, b, c)
        | Op::LastMulAdd(a, b, c)
        | Op::MulAddLast(a, b, c)
        | Op::LastNegMulAdd(a, b, c)
        | Op::NegMulAddLast(a, b, c)
        | Op::Div(a, b, c)
        | Op::CallTwo(a, _, b, c)
        | Op::External(a, _, _, b, c)
        | Op::SinCos(a, b, c) => [a, b, c].into_iter().for_each(|r| visit(r, 0)),
        Op::CallThree(a, _, b, c, d)
        | Op::MulAdd(a, b, c, d)
        | Op::EightMulAdd(a, b, c, d)
        | Op::MulSub(a, b, c, d)
        | Op::NegMulAdd(a, b, c, d) => {
            [a, b, c, d].into_iter().for_each(|r| visit(r, 0));
        }
        Op::Less(to, a, b) | Op::LessEqual(to, a, b) | Op::Equal(to, a, b) => {
            visit(to, 1);
            visit(a, 0);
            visit(b, 0);
        }
        Op::Not(a, b) => [a, b].into_iter().for_each(|r| visit(r, 1)),
        Op::And(a, b, c) | Op::Or(a, b, c) => [a, b, c].into_iter().for_each(|r| visit(r, 1)),
        Op::Select(to, mask, a, b) => {
            visit(mask, 1);
            [to, a, b].into_iter().for_each(|r| visit(r, 0));
        }
        Op::Number01(to, mask) => {
            visit(mask, 1);
            visit(to, 0);
        }
        Op::IsOne(mask, a) => {
            visit(mask, 1);
            visit(a, 0);
        }
        Op::Accumulate {
            sum, term, partial, ..
        } => [sum, term, partial].into_iter().for_each(|r| visit(r, 0)),
        Op::Store(_, _, _, a, b)
        | Op::StoreAt(_, _, _, a, b)
        | Op::AddProductToQ(_, a, b)
        | Op::AddProductToP(_, a, b)
        | Op::SubProductFromQ(_, a, b)
        | Op::SubProductFromP(_, a, b) => {
            [a, b].into_iter().for_each(|r| visit(r, 0));
        }
        Op::Loop(_) | Op::End(_) => {}
    }
}
