//! Faults of programs are found.

use hamiltonian_symbolic::dag::{Array, Column, Parameter, Side, StandIn};
use hamiltonian_symbolic::index::Index;
use hamiltonian_symbolic::program::{
    Function, Instruction, Program, Purpose, Step, Target, Update, Value,
};
use hamiltonian_symbolic::rational::Rational;

/// 2 + 2 into an output.
fn program() -> Program {
    let target = Target::Phase(Column::first(Side::Q, 0));
    Program {
        instructions: vec![
            Instruction::Constant(Rational::integer(2)),
            Instruction::Add(Value(0), Value(0)),
        ],
        functions: vec![Function {
            purpose: Purpose::GradientQ,
            coefficient: Vec::new(),
            evaluation: vec![
                Step::Let(Value(0)),
                Step::Let(Value(1)),
                Step::Store(target, Index::constant(0), None, Update::Set(Value(1))),
            ],
            cleared: Vec::new(),
            results: vec![Value(1)],
        }],
        ..Program::default()
    }
}

#[test]
fn faults_are_found() {
    assert_eq!(program().validate(), Ok(()));
    let faulty = |change: fn(&mut Program), fault: &str| {
        let mut program = program();
        change(&mut program);
        assert_eq!(program.validate(), Err(fault.to_owned()));
    };
    faulty(
        |p| p.functions[0].evaluation.swap(0, 1),
        "_1 reads _0 before it is computed in GradientQ",
    );
    faulty(
        |p| p.functions[0].evaluation.insert(0, Step::Let(Value(0))),
        "_0 is computed twice in GradientQ",
    );
    faulty(
        |p| {
            let store = p.functions[0].evaluation[2].clone();
            p.functions[0].evaluation.push(store);
        },
        "dq0_0[0] is stored twice in GradientQ",
    );
    faulty(
        |p| p.functions[0].results = vec![Value(u32::MAX)],
        "a result of GradientQ reads no value before it is computed",
    );
    faulty(
        |p| p.prepared = vec![Value(1)],
        "what is handed on reads _1 before it is computed",
    );
    faulty(
        |p| {
            p.instructions.push(Instruction::Constant(Rational::ZERO));
            p.prepare = vec![Step::Let(Value(2))];
            p.prepared = vec![Value(2)];
        },
        "_2 is handed on and is a number without a name",
    );
    faulty(
        |p| p.instructions[1] = Instruction::PairedCos(Value(0)),
        "_1 is the cosine of no sine in GradientQ",
    );
    faulty(
        |p| p.instructions[0] = Instruction::StandIn(StandIn::Spent),
        "_0 is Spent, which has no value in GradientQ",
    );
    let parameters = [
        Instruction::Scalar(Parameter(2)),
        Instruction::Load(Array::Parameter(Parameter(2)), Index::constant(0), None),
    ];
    for reads in parameters {
        let mut known = program();
        known.instructions[0] = reads;
        known.parameters = 3;
        assert_eq!(known.validate(), Ok(()));
        known.parameters = 2;
        let fault = "_0 reads parameter 2 of 2 in GradientQ".to_owned();
        assert_eq!(known.validate(), Err(fault));
    }
    faulty(
        |p| p.instructions[0] = Instruction::Load(Array::Hoisted(0), Index::constant(0), None),
        "_0 reads prepared array 0 of 0 in GradientQ",
    );
    let velocity = |p: &mut Program| {
        let velocity = Array::Velocity(Column::first(Side::Q, 0));
        p.instructions[0] = Instruction::Load(velocity, Index::constant(0), None);
    };
    faulty(velocity, "_0 reads a velocity in GradientQ");
}
