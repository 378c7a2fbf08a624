//! Inlined values: expressions written at their only use, instead of in a `let`.
//!
//! Input: the steps of a body. Output: the text of each inlined value. Invariant: the operations and their operands stay
//! the same; a value moves past a store only if it reads no output.

use crate::emit::names::context::{Access, Context};
use hamiltonian_symbolic::dag::{Array, Map};
use hamiltonian_symbolic::program::{Instruction, Step, Value};

/// The greatest length of an inlined text.
const LONGEST: usize = 60;

/// The places of an operand in an expression, in the order of their precedence.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Binding {
    /// An argument, a right-hand side: no parentheses at all.
    Whole,
    /// A term of a sum.
    Term,
    /// A factor of a product.
    Factor,
    /// The receiver of a method.
    Atom,
}

impl Binding {
    /// The tightest place in which the text of an instruction needs no parentheses.
    pub fn of(instruction: &Instruction) -> Binding {
        match instruction {
            Instruction::Add(..) | Instruction::Sub(..) => Binding::Term,
            Instruction::Mul(..) | Instruction::Div(..) | Instruction::Neg(_) => Binding::Factor,
            Instruction::Not(_) | Instruction::And(..) | Instruction::Or(..) => Binding::Whole,
            _ => Binding::Atom,
        }
    }
}

/// The inlined values of a body.
#[derive(Debug, Default)]
pub struct Inlined {
    once: Map<Value, ()>,
    texts: Map<Value, (String, Binding)>,
}

impl Inlined {
    /// Finds the values that are used exactly once, at the outermost level of `steps` or as the one result. Several
    /// `results` are used by name and are not inlined. `reads` are computed earlier.
    pub fn of(context: Context, steps: &[Step], results: &[Value], reads: &[Value]) -> Inlined {
        let by = if results.len() == 1 { 1 } else { 2 };
        let mut uses: Map<Value, u32> = results.iter().map(|value| (*value, by)).collect();
        count(context, steps, 1, &mut uses);
        let is_once = |value: &&Value| uses.get(*value) == Some(&1);
        let reads = reads.iter().filter(is_once).map(|value| (*value, ()));
        let mut once: Map<Value, ()> = reads.collect();
        for step in steps {
            if let Step::Let(value) = step {
                let instruction = context.program.instruction(*value);
                let may_move = match instruction {
                    Instruction::Load(Array::Hoisted(_), ..) => false,
                    Instruction::Load(..) => context.access == Access::Apart,
                    Instruction::PairedSin(_) | Instruction::PairedCos(_) => false,
                    // A function has a branch for rare arguments, which the operations after it wait for.
                    Instruction::Call(..) | Instruction::External(..) => false,
                    _ => true,
                };
                if may_move && is_once(&value) {
                    once.insert(*value, ());
                }
            }
        }
        Inlined {
            once,
            texts: Map::default(),
        }
    }

    /// Takes the text of a value to be inlined. Returns false if it needs a `let`.
    pub fn take(&mut self, value: Value, binding: Binding, text: &str) -> bool {
        let is_taken = text.len() <= LONGEST && self.once.contains_key(&value);
        if is_taken {
            self.texts.insert(value, (text.to_owned(), binding));
        }
        is_taken
    }

    /// Returns the text of an inlined value, with parentheses if the place requires them.
    pub fn text(&self, value: Value, place: Binding) -> Option<String> {
        let (text, binding) = self.texts.get(&value)?;
        Some(match *binding >= place {
            true => text.clone(),
            false => format!("({text})"),
        })
    }
}

/// Counts the uses of values; those in loops count as more than one.
fn count(context: Context, steps: &[Step], by: u32, uses: &mut Map<Value, u32>) {
    for step in steps {
        let mut add = |value: Value| *uses.entry(value).or_default() += by;
        match step {
            Step::Let(value) => context.program.instruction(*value).for_operands(add),
            Step::Accumulate(_, value) => add(*value),
            Step::Store(_, _, _, update) => update.for_operands(add),
            Step::Loop(inner) => count(context, &inner.body, 2, uses),
        }
    }
}
