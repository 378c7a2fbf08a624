//! Properties of scheduled programs: sound, deterministic, never more work than written, and the
//! rules about domains.

use crate::common::{self, PURPOSES};
use crate::soundness;
use crate::tree::{Random, grow};
use hamiltonian_symbolic::dag::{Array, Column, Side};
use hamiltonian_symbolic::interpret::{Point, run};
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::op::Op;
use hamiltonian_symbolic::pipeline::{NoProgram, derive};
use hamiltonian_symbolic::program::{Function, Instruction, Program, Purpose};

#[test]
fn programs_of_random_expressions_are_sound() {
    let mut random = Random(11);
    for _ in 0..common::cases(1_000, 3_000) {
        let (tree, _) = grow(&mut random);
        let program = derive(&mut tree.model(), &PURPOSES).unwrap();
        if std::panic::catch_unwind(|| soundness::check(&program)).is_err() {
            panic!("{}", tree.text());
        }
    }
}

#[test]
fn the_same_model_gives_the_same_program() {
    let mut random = Random(12);
    for _ in 0..300 {
        let (tree, _) = grow(&mut random);
        let first = derive(&mut tree.model(), &PURPOSES).unwrap();
        let second = derive(&mut tree.model(), &PURPOSES).unwrap();
        assert_eq!(first, second);
    }
}

/// The work of an evaluation; a quotient is a reciprocal and a product.
fn work(program: &Program, function: &Function) -> usize {
    let mut quotients = 0;
    soundness::every(&function.evaluation, &mut |value| {
        quotients += usize::from(matches!(program.instruction(value), Instruction::Div(..)));
    });
    program.operations(function).total() + quotients
}

#[test]
fn simplification_adds_no_operation() {
    let mut random = Random(13);
    let (mut more, mut written, mut left) = (0, 0, 0);
    let count = 10_000;
    for _ in 0..count {
        let (tree, _) = grow(&mut random);
        let program = match derive(&mut tree.model(), &[Purpose::Energy]) {
            Err(NoProgram::OutOfRange { .. }) => continue,
            result => result.unwrap(),
        };
        let (before, after) = (tree.operations(), work(&program, &program.functions[0]));
        written += before;
        left += after;
        // Forms that do not overflow may take more.
        if after > before && !tree.has_exponentials() {
            more += 1;
            if more < 20 {
                println!("{before} → {after}: {}", tree.text());
            }
        }
    }
    println!("{written} operations written, {left} left; {more} expressions have more");
    assert!(left <= written && more * 80 <= count);
}

/// The derived program of an H over scalar groups.
fn program(signature: &str, parameters: &str, h: &str, wanted: &[Purpose]) -> Program {
    let mut model = common::system(signature, "", parameters, h);
    let program = derive(&mut model, wanted).unwrap();
    soundness::check(&program);
    program
}

/// The number of such instructions of the first function.
fn count(program: &Program, such: impl Fn(&Instruction) -> bool) -> usize {
    let mut total = 0;
    soundness::every(&program.functions[0].evaluation, &mut |value| {
        total += usize::from(such(program.instruction(value)));
    });
    total
}

fn energy(h: &str, q: f64, p: f64) -> f64 {
    let program = program("q; p", "", h, &[Purpose::Energy]);
    let mut point = Point::<f64>::new();
    for (side, x) in [(Side::Q, q), (Side::P, p)] {
        let array = Array::Phase(Column {
            side,
            group: 0,
            column: 0,
        });
        point.arrays.insert(array, vec![vec![x]]);
    }
    run(&program, &program.functions[0], &point).results[0]
}

#[test]
fn long_products_share_their_parts() {
    for (factors, most) in [(3usize, 3), (10, 24), (50, 144), (200, 594)] {
        let names = |letter: char| {
            let list: Vec<_> = (0..factors).map(|i| format!("{letter}{i}")).collect();
            list.join(", ")
        };
        let signature = format!("{}; {}", names('q'), names('p'));
        let h = names('q').replace(", ", "*");
        let program = program(&signature, "", &h, &[Purpose::GradientQ]);
        let multiplications = count(&program, |i| matches!(i, Instruction::Mul(..)));
        println!("{factors} factors: {multiplications} of {most}");
        assert_eq!(
            program.operations(&program.functions[0]).total(),
            multiplications
        );
        assert!(multiplications <= most);
    }
}

#[test]
fn numbers_are_exact() {
    for (h, value) in [
        ("0.1 + 0.2 - 0.3", 0.0),
        ("q*(1/3 + 1/3 + 1/3)", 7.0),
        ("q*(2/3)*1.5", 7.0),
        ("sqrt(2.25)*q", 10.5),
        ("q + 1e400*1e-400", 8.0),
        ("if 1/3 < 1/2 { q } else { p }", 7.0),
        ("if 32 < 9.81 { p } else { q }", 7.0),
    ] {
        let program = program("q; p", "", h, &[Purpose::Energy]);
        assert_eq!(energy(h, 7.0, f64::NAN), value, "{h}");
        let arithmetic = program.operations(&program.functions[0]).arithmetic;
        assert!(arithmetic <= 1, "{h}: {arithmetic}");
    }
}

#[test]
fn domains_change_by_three_rules_only() {
    // 0·x = 0, x/x = 1, √(x²) = |x|
    assert_eq!(energy("0*ln(q)", -1.0, 0.0), 0.0);
    assert_eq!(energy("q/q", 0.0, 0.0), 1.0);
    assert_eq!(energy("sqrt(q^2)", -3.0, 0.0), 3.0);
    assert_eq!(energy("sqrt(q^2*p^4)", -3.0, 2.0), 12.0);
    assert_eq!(energy("abs(q)^2", 1e200, 0.0), f64::INFINITY);
    // Everything else keeps its domain.
    for (h, q) in [
        ("sqrt(q)*sqrt(q)", -1.0),
        ("sqrt(q)^2", -1.0),
        ("q^0.5*q^0.5", -1.0),
        ("q^1.5/sqrt(q)", -1.0),
        ("q^(1/3)", -8.0),
        ("q^(2/3)", -8.0),
        ("exp(ln(q))", -1.0),
        ("cosh(acosh(q))", 0.0),
        ("ln(q) + ln(p)", -1.0),
        ("sqrt(q)*sqrt(p)", -1.0),
        ("(q^0.25)^4", -1.0),
        ("1/sqrt(q) + 1/q", -1.0),
    ] {
        assert!(energy(h, q, -1.0).is_nan(), "{h}");
    }
    assert_eq!(energy("cbrt(q)^3", -8.0, 0.0), -8.0);
    assert_eq!(energy("ln(q^2)", -1.0, 0.0), 0.0);
    assert_eq!(energy("(q^2)^(1/2)", -2.0, 0.0), 2.0);
    assert_eq!(energy("(q^2)^(3/2)", -2.0, 0.0), 8.0);
    assert_eq!(
        energy("1/sqrt(q^2 + p^2)^3 + 1/(q^2 + p^2)", 0.6, -0.8),
        2.0
    );
}

#[test]
fn parity_shares_calls() {
    let calls = |h: &str| {
        let program = program("a, b; pa, pb", "", h, &[Purpose::Energy]);
        program.operations(&program.functions[0]).functions
    };
    assert_eq!(calls("cos(a - b) + 2*cos(b - a)"), 1);
    assert_eq!(calls("sin(a - b)*pa - sin(b - a)*pb"), 1);
    assert_eq!(calls("exp(a - b) + exp(b - a)"), 2);
    assert_eq!(calls("tanh(-a) + tanh(a)*pa"), 1);
    assert_eq!(calls("abs(a - b) + abs(b - a)"), 0);
}

#[test]
fn sine_and_cosine_of_one_angle_are_one_call() {
    let both = program("q; p", "", "sin(q) + p*cos(q)", &[Purpose::Energy]);
    assert_eq!(count(&both, |i| matches!(i, Instruction::PairedSin(_))), 1);
    assert_eq!(count(&both, |i| matches!(i, Instruction::PairedCos(_))), 1);
    assert_eq!(count(&both, |i| matches!(i, Instruction::Call(..))), 0);
    let one = program("q; p", "", "sin(q)", &[Purpose::GradientQ]);
    assert_eq!(
        count(&one, |i| matches!(i, Instruction::Call(Op::Cos, _))),
        1
    );
    assert_eq!(count(&one, |i| matches!(i, Instruction::PairedSin(_))), 0);
}

#[test]
fn one_division_serves_all_powers() {
    let divisions = |h: &str, wanted: Purpose| {
        let program = program("x, y, z; a, b, c", "", h, &[wanted]);
        count(&program, |i| {
            matches!(i, Instruction::Div(..) | Instruction::Recip(_))
        })
    };
    let r = "sqrt(x^2 + y^2 + z^2)";
    assert_eq!(divisions(&format!("1/{r}"), Purpose::EnergyAndGradient), 1);
    assert_eq!(
        divisions(&format!("1/{r} + a/{r}^3"), Purpose::EnergyAndGradient),
        1
    );
    assert_eq!(divisions("1/x + y/x^3", Purpose::EnergyAndGradient), 1);
    assert_eq!(divisions("x/y + z/y", Purpose::Energy), 1);
    assert_eq!(divisions("x/(y*z)", Purpose::Energy), 1);
    let parameter = program(
        "q; p",
        "m",
        "p^2/(2*m) + q/m",
        &[Purpose::EnergyAndGradient],
    );
    let divides = |i: &Instruction| matches!(i, Instruction::Div(..) | Instruction::Recip(_));
    assert_eq!(count(&parameter, divides), 0);
}

#[test]
fn work_goes_where_it_is_due() {
    let flow = program(
        "q; p; t",
        "m",
        "p^2/(2*m) + cos(q)*cos(t)",
        &[Purpose::VectorField],
    );
    let function = &flow.functions[0];
    // c/m once a step size, nothing but products and additions of it at a step.
    assert_eq!(function.coefficient.len(), 2);
    assert!(!flow.prepare.is_empty());
    assert_eq!(flow.operations(function).divisions, 0);
    let nothing = program("q; p", "m", "m*exp(m)", &[Purpose::EnergyAndGradient]);
    assert_eq!(nothing.operations(&nothing.functions[0]).total(), 0);
    // A value that no function needs is not in the program.
    let kick = program("q; p", "m", "exp(p)/m + q^2", &[Purpose::Kick]);
    assert!(kick.prepare.is_empty());
    assert_eq!(kick.operations(&kick.functions[0]).functions, 0);
}

/// A chain of conditions, each taking the one before twice.
#[test]
fn arrays_of_parameters_alone_are_computed_once() {
    let wanted = [Purpose::Kick, Purpose::Drift, Purpose::Energy];
    let divisions = |h: &str, parameters: &str| -> Vec<usize> {
        let mut model = common::system("q[n][3]; p[n][3]; t", "n", parameters, h);
        let program = derive(&mut model, &wanted).unwrap();
        soundness::check(&program);
        let of = |purpose| {
            let function = program.function(purpose).unwrap();
            program.operations(function).divisions
        };
        let mut all = vec![program.hoisted.len()];
        all.extend(wanted.map(of));
        all
    };
    let gravity = |mass: &str, pair: &str| {
        format!(
            "sum(i in 0..n) {{ (p[i][0]^2 + p[i][1]^2 + p[i][2]^2)/(2*{mass}) }} \
             - sum(i in 0..n) {{ sum(j in 0..i) {{ {pair}/sqrt((q[i][0] - q[j][0])^2 \
             + (q[i][1] - q[j][1])^2 + (q[i][2] - q[j][2])^2) }} }}"
        )
    };
    // 1/m[i] is held; the distance is the one division of a pair.
    let plain = gravity("m[i]", "m[i]*m[j]");
    assert_eq!(divisions(&plain, "m[n]"), [1, 1, 0, 1]);
    // One function of the row, read at i and at j, is one array.
    let charged = gravity("m[i]", "a/m[i]*a/m[j]");
    assert_eq!(divisions(&charged, "m[n] a"), [1, 1, 0, 1]);
    let rooted = gravity("sqrt(1 + m[i]^2)", "m[i]*m[j]");
    assert_eq!(divisions(&rooted, "m[n]"), [1, 1, 0, 1]);
    // A divisor that moves, or is of two rows, is not: each of these divides in its loop.
    assert_eq!(
        divisions(&gravity("(m[i] + t)", "m[i]*m[j]"), "m[n]"),
        [0, 1, 1, 2]
    );
    assert_eq!(divisions(&gravity("2", "1/(m[i] + m[j])"), "m[n]")[0], 0);
}

#[test]
fn nested_conditions_are_differentiated_once() {
    let mut h = "q^2".to_owned();
    for level in 0..40 {
        h = format!("(if p < {level} {{ {h} }} else {{ sin(p*{level}) }})");
    }
    program("q; p", "", &h, &[Purpose::EnergyAndGradient]);
    let mut model: Model = common::system("q; p", "", "", "q*p");
    let mut node = model.h();
    let p = model.scalar(Side::P, 0);
    for level in 0..40 {
        let limit = model.dag.integer(level);
        let (condition, other) = (model.dag.less(p, limit), model.dag.powi(node, 2));
        node = model.dag.select(condition, node, other);
    }
    model.hamiltonian = Some(node);
    soundness::check(&derive(&mut model, &[Purpose::EnergyAndGradient]).unwrap());
}

#[test]
fn a_program_prints_as_text() {
    let mut pendulum = common::system("theta; p", "", "m l g", "p^2/(2*m*l^2) - m*g*l*cos(theta)");
    let program = derive(&mut pendulum, &[Purpose::EnergyAndGradient, Purpose::Kick]).unwrap();
    assert_eq!(
        program.to_string().lines().collect::<Vec<_>>(),
        [
            "prepare",
            "  _0 = a0",
            "  _1 = a1",
            "  _2 = a2",
            "  _3 = 0.5",
            "  _4 = _0*_1",
            "  _5 = _4*_2",
            "  _6 = _1*_4",
            "  _7 = 1/_6",
            "  _8 = _3/_6",
            "EnergyAndGradient",
            "  _9 = p0_0[0]",
            "  _10 = q0_0[0]",
            "  _11 = sin(_10)",
            "  _12 = cos beside _11",
            "  _13 = _8*_9",
            "  _14 = _13*_9",
            "  _15 = _14 - _5*_12",
            "  _16 = _7*_9",
            "  _17 = _5*_11",
            "  dp0_0[0] = _16",
            "  dq0_0[0] = _17",
            "  return _15",
            "Kick",
            "  with a coefficient",
            "    _18 = c",
            "    _19 = _18*_0",
            "    _20 = _19*_2",
            "    _21 = _20*_1",
            "  _22 = q0_0[0]",
            "  _23 = sin(_22)",
            "  dp0_0[0] -= _21*_23",
        ]
    );
    let mut toda = common::system(
        "q[n]; p[n]",
        "n",
        "",
        "sum(i in 0..n) { p[i]^2/2 + exp(q[i] - q[(i + 1) % n]) }",
    );
    let program = derive(&mut toda, &[Purpose::GradientQ]).unwrap();
    assert_eq!(
        program.to_string().lines().collect::<Vec<_>>(),
        [
            "prepare",
            "GradientQ",
            "  dq0_0 = 0",
            "  for i0 in 0..n0",
            "    _0 = q0_0[i0]",
            "    _1 = q0_0[(i0 + 1) % (n0)]",
            "    _2 = _0 - _1",
            "    _3 = exp(_2)",
            "    dq0_0[i0] += _3",
            "    dq0_0[(i0 + 1) % (n0)] -= _3",
        ]
    );
}
