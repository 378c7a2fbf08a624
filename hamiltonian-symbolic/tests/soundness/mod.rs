//! Conditions on every scheduled program, whatever it computes.
//!
//! Input: a program. Output: a panic where it is not sound. Invariant: knows the form of programs
//! only, nothing of how they are made.

use hamiltonian_symbolic::dag::Array;
use hamiltonian_symbolic::program::{Function, Instruction, Loop, Program, Step, Update, Value};
use std::collections::HashSet;

/// Values are computed once and before their uses, nothing is computed in vain, preparation reads
/// parameters alone, the coefficient stage parameters and the coefficient, and what could be
/// prepared is not computed at every evaluation.
pub fn check(program: &Program) {
    let mut computed = HashSet::new();
    let mut scope = HashSet::new();
    defined(program, &program.prepare, &mut scope, &mut computed);
    for value in &program.prepared {
        assert!(scope.contains(value), "{value:?} is handed on unprepared");
    }
    let prepared: HashSet<Value> = program.prepared.iter().copied().collect();
    let mut read = HashSet::new();
    for function in &program.functions {
        let mut scope = prepared.clone();
        defined(program, &function.coefficient, &mut scope, &mut computed);
        defined(program, &function.evaluation, &mut scope, &mut computed);
        for value in &function.results {
            assert!(scope.contains(value), "{value:?} is returned uncomputed");
        }
        let mut live: HashSet<Value> = function.results.iter().copied().collect();
        alive(program, &function.evaluation, &mut live);
        alive(program, &function.coefficient, &mut live);
        no_more_than(program, &function.evaluation, &live);
        no_more_than(program, &function.coefficient, &live);
        read.extend(live.intersection(&prepared).copied());
        stages(program, function, &prepared);
    }
    assert_eq!(read, prepared, "what is handed on is read");
    let mut live = prepared;
    alive(program, &program.prepare, &mut live);
    no_more_than(program, &program.prepare, &live);
    every(&program.prepare, &mut |value| {
        let stage = of(program.instruction(value));
        assert_eq!(stage, 0, "prepared: {:?}", program.instruction(value));
    });
    assert_eq!(computed.len(), program.instructions.len(), "no orphans");
}

/// The operands of an instruction.
pub fn operands(instruction: &Instruction) -> Vec<Value> {
    use Instruction::*;
    match instruction {
        Constant(_) | Pi | Scalar(_) | Time | Coefficient | Variable(_) | Extent(_) | Count(..)
        | Load(..) | Accumulator | StandIn(_) => vec![],
        Neg(a) | Recip(a) | PairedSin(a) | PairedCos(a) | Not(a) => vec![*a],
        Add(a, b) | Sub(a, b) | Mul(a, b) | Div(a, b) | Compare(_, a, b) | And(a, b) | Or(a, b) => {
            vec![*a, *b]
        }
        MulAdd(a, b, c) | MulSub(a, b, c) | NegMulAdd(a, b, c) | Select(a, b, c) => {
            vec![*a, *b, *c]
        }
        Call(_, list) | External(_, _, list) => list.clone(),
    }
}

fn stored(update: &Update) -> Vec<Value> {
    match *update {
        Update::Set(a) | Update::Add(a) | Update::Sub(a) => vec![a],
        Update::AddProduct(a, b) | Update::SubProduct(a, b) => vec![a, b],
    }
}

fn defined(
    program: &Program,
    steps: &[Step],
    scope: &mut HashSet<Value>,
    computed: &mut HashSet<Value>,
) {
    for step in steps {
        match step {
            Step::Let(value) => {
                for operand in operands(program.instruction(*value)) {
                    assert!(
                        scope.contains(&operand),
                        "{value:?} reads {operand:?} too soon"
                    );
                }
                assert!(computed.insert(*value), "{value:?} is computed twice");
                scope.insert(*value);
            }
            Step::Accumulate(sum, value) => {
                assert_eq!(*program.instruction(*sum), Instruction::Accumulator);
                assert!(scope.contains(value), "{value:?} is added too soon");
            }
            Step::Store(_, _, _, update) => {
                for value in stored(update) {
                    assert!(scope.contains(&value), "{value:?} is stored too soon");
                }
            }
            Step::Loop(l) => {
                for sum in &l.accumulators {
                    assert!(computed.insert(*sum));
                }
                let mut inside = scope.clone();
                defined(program, &l.body, &mut inside, computed);
                scope.extend(&l.accumulators);
            }
        }
    }
}

/// Adds the operands of the live values, last step first.
fn alive(program: &Program, steps: &[Step], live: &mut HashSet<Value>) {
    for step in steps.iter().rev() {
        match step {
            Step::Let(value) => {
                if live.contains(value) {
                    live.extend(operands(program.instruction(*value)));
                }
            }
            Step::Accumulate(sum, value) => {
                if live.contains(sum) {
                    live.insert(*value);
                }
            }
            Step::Store(_, _, _, update) => live.extend(stored(update)),
            Step::Loop(l) => alive(program, &l.body, live),
        }
    }
}

fn no_more_than(program: &Program, steps: &[Step], live: &HashSet<Value>) {
    every(steps, &mut |value| {
        assert!(
            live.contains(&value),
            "nobody reads {value:?} = {:?}",
            program.instruction(value)
        );
    });
}

/// Visits every value computed, accumulators included.
pub fn every(steps: &[Step], visit: &mut impl FnMut(Value)) {
    for step in steps {
        match step {
            Step::Let(value) => visit(*value),
            Step::Loop(l) => {
                l.accumulators.iter().for_each(|sum| visit(*sum));
                every(&l.body, visit);
            }
            Step::Accumulate(..) | Step::Store(..) => {}
        }
    }
}

/// All loops, outer ones first.
pub fn loops(steps: &[Step]) -> Vec<&Loop> {
    let mut all = Vec::new();
    for step in steps {
        if let Step::Loop(l) = step {
            all.push(l);
            all.extend(loops(&l.body));
        }
    }
    all
}

/// The stage an instruction by itself belongs to: 0 parameters, 1 coefficient, 2 evaluation.
fn of(instruction: &Instruction) -> u8 {
    match instruction {
        Instruction::Coefficient => 1,
        Instruction::Time | Instruction::Load(Array::Phase(_) | Array::Direction(_), ..) => 2,
        _ => 0,
    }
}

/// Outside loops nothing is computed later than it can be (but numbers and negatives, which are
/// free).
fn stages(program: &Program, function: &Function, prepared: &HashSet<Value>) {
    let mut earliest: std::collections::HashMap<Value, u8> =
        prepared.iter().map(|value| (*value, 0)).collect();
    for (stage, steps) in [(1, &function.coefficient), (2, &function.evaluation)] {
        for step in steps {
            let Step::Let(value) = step else { continue };
            let instruction = program.instruction(*value);
            let own = operands(instruction)
                .iter()
                // Sums of loops are left out: they may depend on anything.
                .map(|operand| earliest.get(operand).copied().unwrap_or(2))
                .fold(of(instruction), u8::max);
            earliest.insert(*value, own);
            assert!(own <= stage);
            assert!(
                // The coefficient stage runs once per step size; it may repeat preparations.
                own == stage
                    || stage == 1
                    || matches!(
                        instruction,
                        Instruction::Constant(_) | Instruction::Pi | Instruction::Neg(_)
                    ),
                "{instruction:?} could be computed before"
            );
        }
    }
}
