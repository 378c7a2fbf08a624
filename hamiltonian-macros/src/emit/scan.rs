//! What a block of steps reads, computes and writes.
//!
//! Input: steps. Output: [`Scan`]. Invariant: lists are in order of first occurrence (sorted where
//! it says so), without repetition.

use super::layout::{Layout, Slice};
use hamiltonian_symbolic::program::{Instruction, Program, Step, Update, Value};

/// What a block does.
#[derive(Debug, Default)]
pub struct Scan {
    /// Values it reads but does not compute; numbers are not among them, they stand where they are
    /// used.
    pub reads: Vec<Value>,
    /// Values it computes at its own level, accumulators of its own loops included.
    pub computes: Vec<Value>,
    /// Slices it reads or writes, sorted.
    pub slices: Vec<Slice>,
}

/// What a set of values knows about itself: a bit for each value of a program.
#[derive(Debug)]
pub struct Marks(Vec<bool>);

impl Marks {
    /// No value of a program.
    pub fn new(program: &Program) -> Marks {
        Marks(vec![false; program.instructions.len()])
    }
    /// Adds a value; whether it was new.
    pub fn insert(&mut self, value: Value) -> bool {
        !core::mem::replace(&mut self.0[value.0 as usize], true)
    }
}

/// Calls `visit` with each operand of an instruction.
pub fn for_operands(instruction: &Instruction, mut visit: impl FnMut(Value)) {
    match instruction {
        Instruction::Constant(_)
        | Instruction::Pi
        | Instruction::Scalar(_)
        | Instruction::Time
        | Instruction::Coefficient
        | Instruction::Variable(_)
        | Instruction::Extent(_)
        | Instruction::Count(..)
        | Instruction::Load(..)
        | Instruction::Accumulator => {}
        Instruction::Neg(a)
        | Instruction::Recip(a)
        | Instruction::Call(_, a)
        | Instruction::PairedSin(a)
        | Instruction::PairedCos(a)
        | Instruction::Not(a) => visit(*a),
        Instruction::Add(a, b)
        | Instruction::Sub(a, b)
        | Instruction::Mul(a, b)
        | Instruction::Div(a, b)
        | Instruction::Call2(_, a, b)
        | Instruction::Compare(_, a, b)
        | Instruction::And(a, b)
        | Instruction::Or(a, b) => {
            visit(*a);
            visit(*b);
        }
        Instruction::MulAdd(a, b, c)
        | Instruction::MulSub(a, b, c)
        | Instruction::NegMulAdd(a, b, c)
        | Instruction::Select(a, b, c) => {
            visit(*a);
            visit(*b);
            visit(*c);
        }
        Instruction::External(_, _, arguments) => arguments.iter().copied().for_each(visit),
    }
}

/// Calls `visit` with each value an update reads.
pub fn for_update(update: &Update, mut visit: impl FnMut(Value)) {
    match update {
        Update::Set(a) | Update::Add(a) | Update::Sub(a) => visit(*a),
        Update::AddProduct(a, b) | Update::SubProduct(a, b) => {
            visit(*a);
            visit(*b);
        }
    }
}

/// Whether an instruction is a number that stands where it is used.
pub fn is_number(instruction: &Instruction) -> bool {
    matches!(instruction, Instruction::Constant(_) | Instruction::Pi)
}

/// Whether an instruction makes a mask.
pub fn is_mask(instruction: &Instruction) -> bool {
    matches!(
        instruction,
        Instruction::Compare(..) | Instruction::Not(_) | Instruction::And(..) | Instruction::Or(..)
    )
}

/// What a block with these results does.
pub fn scan(program: &Program, layout: Layout, steps: &[Step], results: &[Value]) -> Scan {
    let mut walker = Walker {
        program,
        layout,
        known: Marks::new(program),
        scan: Scan::default(),
    };
    walker.walk(steps, true);
    for &result in results {
        walker.read(result);
    }
    walker.scan.slices.sort_unstable();
    walker.scan.slices.dedup();
    walker.scan
}

struct Walker<'a> {
    program: &'a Program,
    layout: Layout,
    known: Marks,
    scan: Scan,
}

impl Walker<'_> {
    fn read(&mut self, value: Value) {
        if !is_number(self.program.instruction(value)) && self.known.insert(value) {
            self.scan.reads.push(value);
        }
    }

    fn walk(&mut self, steps: &[Step], outer: bool) {
        for step in steps {
            match step {
                Step::Let(value) => {
                    let instruction = self.program.instruction(*value);
                    for_operands(instruction, |operand| self.read(operand));
                    if let Instruction::Load(array, ..) = instruction {
                        self.scan.slices.push(Slice::read(self.layout, *array));
                    }
                    self.compute(*value, outer);
                }
                Step::Accumulate(to, value) => {
                    self.read(*to);
                    self.read(*value);
                }
                Step::Store(target, _, _, update) => {
                    for_update(update, |operand| self.read(operand));
                    self.scan.slices.push(Slice::write(self.layout, *target));
                }
                Step::Loop(inner) => {
                    for &accumulator in &inner.accumulators {
                        self.compute(accumulator, outer);
                    }
                    self.walk(&inner.body, false);
                }
            }
        }
    }

    fn compute(&mut self, value: Value, outer: bool) {
        if !is_number(self.program.instruction(value)) && self.known.insert(value) && outer {
            self.scan.computes.push(value);
        }
    }
}
