//! The order of steps: few values are alive at once.

use hamiltonian_symbolic::dag::Side;
use hamiltonian_symbolic::model::{Group, Model};
use hamiltonian_symbolic::op::Op;
use hamiltonian_symbolic::pipeline;
use hamiltonian_symbolic::program::{Program, Purpose, Step, Value};
use hamiltonian_symbolic::rational::Rational;
use std::collections::HashSet;

/// Value and gradient of Σ sin(k·q).
fn waves(count: i64) -> Program {
    let mut model = Model {
        groups: vec![Group::scalar("q", "p")],
        ..Model::default()
    };
    let q = model.scalar(Side::Q, 0);
    let dag = &mut model.dag;
    let waves: Vec<_> = (1..=count)
        .map(|k| {
            let angle = dag.scale(&Rational::integer(k), q);
            dag.call(Op::Sin, &[angle])
        })
        .collect();
    model.hamiltonian = Some(dag.add(&waves));
    pipeline::derive(&mut model, &[Purpose::EnergyAndGradient]).unwrap()
}

/// The most values that are computed and still to be read, after any step; steps whose
/// operands are not computed panic.
fn most_alive(program: &Program, steps: &[Step], results: &[Value]) -> usize {
    let reads = |step: &Step| {
        let mut reads = Vec::new();
        match step {
            Step::Let(value) => {
                (program.instruction(*value)).for_operands(|operand| reads.push(operand));
            }
            Step::Store(_, _, _, update) => update.for_operands(|value| reads.push(value)),
            Step::Accumulate(..) | Step::Loop(_) => {}
        }
        reads.retain(|value| !program.instruction(*value).is_number());
        reads
    };
    let mut computed = HashSet::new();
    let mut most = 0;
    for (at, step) in steps.iter().enumerate() {
        assert!(reads(step).iter().all(|value| computed.contains(value)));
        if let Step::Let(value) = step
            && !program.instruction(*value).is_number()
        {
            assert!(computed.insert(*value), "{value:?} is computed twice");
        }
        let later: HashSet<Value> = steps[at + 1..].iter().flat_map(reads).collect();
        let is_alive = |value: &&Value| later.contains(value) || results.contains(value);
        most = most.max(computed.iter().filter(is_alive).count());
    }
    most
}

#[test]
fn a_long_sum_keeps_little_alive() {
    let program = waves(100);
    let function = &program.functions[0];
    let before = most_alive(&program, &function.evaluation, &function.results);
    let steps = program.compact(&function.evaluation);
    assert_eq!(steps.len(), function.evaluation.len());
    let after = most_alive(&program, &steps, &function.results);
    // q, the two sums, a sine and its cosine.
    assert!(
        before >= 100 && after <= 5,
        "{before} before, {after} after"
    );
}
