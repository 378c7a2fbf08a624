//! Values that a block of steps reads, computes and writes.
//!
//! Input: steps. Output: [`Scan`]. Invariant: lists are in order of first occurrence (sorted where
//! it says so), without repetition.

use crate::emit::names::context::Context;
use crate::emit::names::layout::Slice;
use hamiltonian_symbolic::program::{Instruction, Program, Step, Value};
use hamiltonian_symbolic::sort::Arrange;

/// The reads and writes of a block.
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

/// The reads and writes of a block with these results.
pub fn scan(context: Context, steps: &[Step], results: &[Value]) -> Scan {
    let mut walker = Walker {
        program: context.program,
        context,
        known: vec![false; context.program.instructions.len()],
        scan: Scan::default(),
    };
    walker.walk(steps, true);
    for &result in results {
        walker.read(result);
    }
    walker.scan.slices.arrange();
    walker.scan.slices.dedup();
    walker.scan
}

struct Walker<'a> {
    program: &'a Program,
    context: Context<'a>,
    /// True for each value of the program that was met.
    known: Vec<bool>,
    scan: Scan,
}

impl Walker<'_> {
    /// Returns true if a value is met for the first time; numbers stand where they are used.
    fn is_new(&mut self, value: Value) -> bool {
        let known = &mut self.known[value.0 as usize];
        !self.program.instruction(value).is_number() && !std::mem::replace(known, true)
    }

    fn read(&mut self, value: Value) {
        if self.is_new(value) {
            self.scan.reads.push(value);
        }
    }

    fn walk(&mut self, steps: &[Step], outer: bool) {
        for step in steps {
            match step {
                Step::Let(value) => {
                    let instruction = self.program.instruction(*value);
                    instruction.for_operands(|operand| self.read(operand));
                    if let Instruction::Load(array, ..) = instruction {
                        self.scan.slices.push(self.context.read(*array));
                    }
                    self.compute(*value, outer);
                }
                Step::Accumulate(to, value) => {
                    self.read(*to);
                    self.read(*value);
                }
                Step::Store(target, _, _, update) => {
                    update.for_operands(|operand| self.read(operand));
                    let slice = Slice::write(self.context.layout, *target);
                    self.scan.slices.push(slice);
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
        if self.is_new(value) && outer {
            self.scan.computes.push(value);
        }
    }
}
