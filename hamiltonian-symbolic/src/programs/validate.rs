//! Checks that a program can be emitted.
//!
//! Input: a program. Output: nothing, or the first fault of the program, which is a fault of the engine.
//! Invariant: the checks depend on the program alone, not on the passes that made it.

use crate::dag::{Array, Map};
use crate::index::Index;
use crate::program::{Function, Instruction, Program, Step, Target, Update, Value};

/// The values that are known at a place.
type Known = Map<Value, ()>;
/// The elements a function sets, each of which may be set once.
type Stored = Map<(Target, Index, Option<Index>), ()>;

impl Program {
    /// Checks that every value is computed once and before its uses, that parameters and prepared arrays are declared,
    /// that no node stands in the place of another, that no number is handed on by name, and that an element that is
    /// overwritten is stored once.
    ///
    /// # Errors
    /// The first violation.
    pub fn validate(&self) -> Result<(), String> {
        let mut computed = Known::default();
        let mut scope = Known::default();
        let mut nothing = Stored::default();
        self.block(&self.prepare, &mut scope, &mut computed, &mut nothing)?;
        let mut prepared = Known::default();
        for value in &self.prepared {
            read(*value, &scope, || "what is handed on".to_owned())?;
            if self.instruction(*value).is_number() {
                return Err(format!(
                    "{value} is handed on and is a number without a name"
                ));
            }
            prepared.insert(*value, ());
        }
        for function in &self.functions {
            let Function { purpose, .. } = function;
            let mut scope = prepared.clone();
            let mut stored = Stored::default();
            for steps in [&function.coefficient, &function.evaluation] {
                self.block(steps, &mut scope, &mut computed, &mut stored)
                    .map_err(|fault| format!("{fault} in {purpose:?}"))?;
            }
            for value in &function.results {
                read(*value, &scope, || format!("a result of {purpose:?}"))?;
            }
        }
        Ok(())
    }

    fn block(
        &self,
        steps: &[Step],
        scope: &mut Known,
        computed: &mut Known,
        stored: &mut Stored,
    ) -> Result<(), String> {
        for step in steps {
            match step {
                Step::Let(value) => {
                    let Some(instruction) = self.instructions.get(value.0 as usize) else {
                        return Err(format!("{value} has no instruction"));
                    };
                    let mut missing = None;
                    instruction.for_operands(|operand| {
                        if !scope.contains_key(&operand) {
                            missing = Some(operand);
                        }
                    });
                    if let Some(operand) = missing {
                        return Err(format!("{value} reads {operand} before it is computed"));
                    }
                    match instruction {
                        Instruction::Load(Array::Velocity(_), ..) => {
                            return Err(format!("{value} reads a velocity"));
                        }
                        Instruction::StandIn(what) => {
                            return Err(format!("{value} is {what:?}, which has no value"));
                        }
                        Instruction::Scalar(parameter)
                        | Instruction::Load(Array::Parameter(parameter), ..)
                            if usize::from(parameter.0) >= self.parameters =>
                        {
                            return Err(format!(
                                "{value} reads parameter {} of {}",
                                parameter.0, self.parameters
                            ));
                        }
                        Instruction::Load(Array::Hoisted(number), ..)
                            if usize::from(*number) >= self.hoisted.len() =>
                        {
                            return Err(format!(
                                "{value} reads prepared array {number} of {}",
                                self.hoisted.len()
                            ));
                        }
                        _ => {}
                    }
                    if let Instruction::PairedCos(sine) = instruction
                        && !matches!(self.instruction(*sine), Instruction::PairedSin(_))
                    {
                        return Err(format!("{value} is the cosine of no sine"));
                    }
                    define(*value, scope, computed)?;
                }
                Step::Accumulate(sum, value) => {
                    read(*value, scope, || format!("a term of {sum}"))?;
                    read(*sum, scope, || "a sum".to_owned())?;
                }
                Step::Store(target, row, column, update) => {
                    let mut values = Vec::new();
                    update.for_operands(|value| values.push(value));
                    for value in values {
                        read(value, scope, || format!("{target}[{row}]"))?;
                    }
                    let element = (*target, row.clone(), column.clone());
                    let again = stored.insert(element, ()).is_some();
                    if again && matches!(update, Update::Set(_)) {
                        return Err(format!("{target}[{row}] is stored twice"));
                    }
                }
                Step::Loop(nest) => {
                    for sum in &nest.accumulators {
                        define(*sum, scope, computed)?;
                    }
                    let mut inside = scope.clone();
                    self.block(&nest.body, &mut inside, computed, stored)?;
                }
            }
        }
        Ok(())
    }
}

fn read(value: Value, scope: &Known, what: impl Fn() -> String) -> Result<(), String> {
    match scope.contains_key(&value) {
        true => Ok(()),
        false => Err(format!("{} reads {value} before it is computed", what())),
    }
}

fn define(value: Value, scope: &mut Known, computed: &mut Known) -> Result<(), String> {
    scope.insert(value, ());
    match computed.insert(value, ()) {
        None => Ok(()),
        Some(()) => Err(format!("{value} is computed twice")),
    }
}
