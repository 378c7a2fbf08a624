//! Iterations of innermost loops as functions.
//!
//! Input: the steps of one iteration. Output: its loads, a call of its arithmetic, its stores.
//! Invariant: the arithmetic is a function over any scalar, so a pack of iterations can be made by one
//! call.

use super::block::{Writer, name, names};
use super::values::Wanted;
use crate::emit::steps::scan::scan;
use hamiltonian_symbolic::list::IntoList;
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
                Step::Let(value) if is_given(value) => given.push(step.clone()),
                Step::Let(_) => computed.push(step.clone()),
                Step::Store(..) | Step::Accumulate(..) => rest.push(step.clone()),
                Step::Loop(_) => return self.steps(steps),
            }
        }
        let scan = |steps: &[Step]| scan(self.context, steps, &[]);
        let (arithmetic, mut results) = (scan(&computed), scan(&rest).reads);
        let inside: Wanted = arithmetic.computes.iter().map(|v| (*v, ())).collect();
        results.retain(|value| inside.contains_key(value));
        let (Some(first), false) = (arithmetic.computes.first(), results.is_empty()) else {
            return self.steps(steps);
        };
        let arguments = arithmetic.reads;
        self.steps(&given);
        let ty = |value: &Value| match program.instruction(*value).is_mask() {
            true => "<T as __h::Real>::Mask",
            false => "T",
        };
        let function = format!("__body{}", first.0);
        let functions = &self.context.generics.functions;
        let types = self.context.generics.bounded_functions();
        let types: String = types.map(|ty| format!(", {ty}")).collect();
        let passed = (0..functions.len()).map(|at| format!("_f{at}"));
        let passed: Vec<String> = passed.chain(arguments.iter().map(|v| name(*v))).into_list();
        let given = functions.iter().enumerate();
        let declared: Vec<String> = given
            .map(|(at, (ty, _))| format!("_f{at}: &{ty}"))
            .chain(
                arguments
                    .iter()
                    .map(|value| format!("{}: {}", name(*value), ty(value))),
            )
            .into_list();
        line!(
            self,
            "#[inline(always)]\n#[allow(clippy::too_many_arguments)]\n\
             fn {function}<T: __h::Real{types}>({}) -> ({}) {{",
            declared.join(", "),
            "T, ".repeat(results.len())
        );
        self.steps(&computed);
        line!(self, "({},)\n}}", names(&results));
        line!(
            self,
            "let ({},) = {function}({});",
            names(&results),
            passed.join(", ")
        );
        self.steps(&rest);
    }
}
