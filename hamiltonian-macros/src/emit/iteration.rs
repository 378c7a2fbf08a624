//! Iterations of innermost loops as functions.
//!
//! Input: the steps of one iteration. Output: its loads, a call of its arithmetic, its stores.
//! Invariant: the arithmetic is a function over any scalar, so a pack of iterations can be made by one
//! call.

use super::block::{Writer, name, names};
use super::scan::Marks;
use hamiltonian_symbolic::program::{Instruction, Step, Value};
use std::fmt::Write;

impl Writer<'_> {
    /// An iteration of an innermost loop: loads, a call of its arithmetic, stores. The arithmetic is
    /// a function over any scalar, so that a pack of iterations can be made by one call.
    pub(super) fn iteration(&mut self, steps: &[Step]) {
        let program = self.context.program;
        let is_given = |value: &Value| {
            matches!(
                program.instruction(*value),
                Instruction::Scalar(_)
                    | Instruction::Time
                    | Instruction::Coefficient
                    | Instruction::Variable(_)
                    | Instruction::Extent(_)
                    | Instruction::Count(..)
                    | Instruction::Load(..)
            )
        };
        let (mut given, mut computed, mut rest) = (Vec::new(), Vec::new(), Vec::new());
        for step in steps {
            match step {
                Step::Let(value) if program.instruction(*value).is_number() => {}
                Step::Let(value) if is_given(value) => given.push(step.clone()),
                Step::Let(value) => computed.push((*value, step.clone())),
                Step::Store(..) | Step::Accumulate(..) => rest.push(step.clone()),
                Step::Loop(_) => return self.steps(steps),
            }
        }
        let mut known = Marks::new(program);
        let (mut arguments, mut results) = (Vec::new(), Vec::new());
        for (value, _) in &computed {
            program.instruction(*value).for_operands(|operand| {
                if !program.instruction(operand).is_number() && known.insert(operand) {
                    arguments.push(operand);
                }
            });
            known.insert(*value);
        }
        let mut inside = Marks::new(program);
        for (value, _) in &computed {
            inside.insert(*value);
        }
        let mut result = |operand| {
            if inside.remove(operand) {
                results.push(operand);
            }
        };
        for step in &rest {
            match step {
                Step::Accumulate(_, value) => result(*value),
                Step::Store(_, _, _, update) => update.for_operands(&mut result),
                Step::Let(_) | Step::Loop(_) => {}
            }
        }
        let (Some((first, _)), false) = (computed.first(), results.is_empty()) else {
            return self.steps(steps);
        };
        self.steps(&given);
        let ty = |value: &Value| match program.instruction(*value).is_mask() {
            true => "<T as __h::Real>::Mask",
            false => "T",
        };
        let function = format!("__body{}", first.0);
        let declared: Vec<String> = (arguments.iter())
            .map(|value| format!("{}: {}", name(*value), ty(value)))
            .collect();
        line!(
            self,
            "#[inline(always)]\n#[allow(clippy::too_many_arguments)]\n\
             fn {function}<T: __h::Real>({}) -> ({}) {{",
            declared.join(", "),
            "T, ".repeat(results.len())
        );
        let computed: Vec<Step> = computed.into_iter().map(|(_, step)| step).collect();
        self.steps(&computed);
        line!(self, "({},)\n}}", names(&results));
        line!(
            self,
            "let ({},) = {function}({});",
            names(&results),
            names(&arguments)
        );
        self.steps(&rest);
    }
}
