//! Depth costs no stack, size is bounded, nothing panics.

use crate::common::{model, parse, system};
use hamiltonian_symbolic::bracket::{Verdict, bracket, is_invariant};
use hamiltonian_symbolic::dag::Node;
use hamiltonian_symbolic::index::LOOPS;
use hamiltonian_symbolic::legendre::transform;
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::normal_form::{Proof, is_zero};
use hamiltonian_symbolic::op::Op;
use hamiltonian_symbolic::pipeline::{NoProgram, derive};
use hamiltonian_symbolic::print::{Notation, hamilton_equations, latex, text};
use hamiltonian_symbolic::program::{Purpose, Step};
use hamiltonian_symbolic::rational::Rational;
use hamiltonian_symbolic::structure::analyse;

/// Runs on a stack no larger than a main thread's smallest.
fn on_a_small_stack(work: impl FnOnce() + Send) {
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new()
            .stack_size(64 * 1024)
            .spawn_scoped(scope, work)
            .unwrap();
        thread.join().unwrap();
    });
}

/// A chain of this many functions, each of which is of a kind with rules of its own.
fn chain(m: &mut Model, from: Node, ops: &[Op], count: usize) -> Node {
    let mut node = from;
    for at in 0..count {
        node = m.dag.call(ops[at % ops.len()], &[node]);
    }
    node
}

fn everything(m: &mut Model, h: Node) {
    m.hamiltonian = Some(h);
    let x = parse(m, "q");
    let _ = is_zero(m, h);
    let _ = is_invariant(m, x, None);
    let _ = is_invariant(m, x, Some(x));
    let _ = analyse(m);
    let _ = text(m, h);
    let _ = latex(m, h);
    let _ = hamilton_equations(m).written(Notation::Text);
    let _ = transform(m, h);
}

#[test]
fn depth_costs_no_stack() {
    on_a_small_stack(|| {
        for ops in [
            &[Op::Sin][..],
            &[Op::Sqrt],
            &[Op::Exp],
            &[Op::Ln],
            &[Op::Ln, Op::Sqrt],
            &[Op::Abs, Op::Cbrt],
            &[Op::Cbrt, Op::Sign],
            &[Op::Tanh, Op::Atan, Op::Asinh],
        ] {
            let mut m = model("q, x; p, u", "", "a");
            let from = parse(&mut m, "q + p");
            let h = chain(&mut m, from, ops, 250);
            everything(&mut m, h);
        }
        let mut m = model("q, x; p, u", "", "a");
        let mut node = parse(&mut m, "q*p");
        let one = m.dag.integer(1);
        for _ in 0..500 {
            let sum = m.dag.add(&[one, node]);
            node = m.dag.powi(sum, -1);
        }
        everything(&mut m, node);
    });
}

#[test]
fn size_is_bounded() {
    let mut m = model("q, x; p, u", "", "a");
    let h = parse(&mut m, "(q + x + p + u + a + 1)^40/(q + p)^30");
    everything(&mut m, h);
    assert_eq!(is_zero(&m, h), is_zero(&m, h));
    let x = parse(&mut m, "q");
    let terms: Vec<_> = (2..6000)
        .map(|n| (Rational::integer(n), m.dag.powi(x, (n % 1000) as i32)))
        .collect();
    let sum = m.dag.linear(&Rational::ONE, &terms);
    let p = parse(&mut m, "p");
    let h = m.dag.mul(&[sum, p]);
    everything(&mut m, h);
}

#[test]
fn edges_are_answered() {
    let mut m = system("q; p", "", "a", "a - a");
    assert!(matches!(analyse(&mut m).separable, Ok(split) if m.dag.is_zero(split.kinetic)));
    let still = [("dq/dt", "0"), ("dp/dt", "0")].map(|(of, is)| (of.to_owned(), is.to_owned()));
    assert_eq!(hamilton_equations(&m).written(Notation::Text), still);
    let q = parse(&mut m, "q");
    assert!(is_invariant(&m, q, None).is_proven());
    for source in [
        "1/0*q",
        "0^-1 + q",
        "1/(q - q)",
        "sqrt(-1)*q",
        "ln(0) + q",
        "q^(1/0)",
        "1e400*q",
        "q^1e9",
        "2^q/0",
    ] {
        let mut m = model("q, x; p, u", "", "a");
        let h = parse(&mut m, source);
        assert_ne!(is_zero(&m, h), Proof::Zero, "{source}");
        everything(&mut m, h);
    }
    // An empty loop, a loop that never runs, a size of its own.
    let mut m = system(
        "q[N], s; p[N], r",
        "N",
        "",
        "sum(i in 3..1) { q[i] } + sum(i in N..N) { p[i] } + sum(i in 0..N - 5) { q[i]*p[i] } + r^2",
    );
    let _ = analyse(&mut m);
    let _ = hamilton_equations(&m).written(Notation::Latex);
    let s = parse(&mut m, "r");
    assert!(is_invariant(&m, s, None).is_proven());
}

#[test]
fn the_same_question_has_the_same_answer() {
    let ask = || {
        let mut m = system("x, y; u, v", "", "k", "(u^2 + v^2)/2 - k/sqrt(x^2 + y^2)");
        let good = parse(&mut m, "x*v - y*u");
        let bad = parse(&mut m, "x*v + y*u");
        format!(
            "{:?} {:?} {:?}",
            is_invariant(&m, good, None),
            is_invariant(&m, bad, None),
            analyse(&mut m)
        )
    };
    assert_eq!(ask(), ask());
}

/// One loop for each of `from..N` with from below `count`.
fn many_loops(count: usize) -> Model {
    let sums = (0..count).map(|from| format!("sum(i in {from}..N) {{ p[i]^2*{}/2 }}", from + 1));
    system("q[N]; p[N]", "N", "", &sums.collect::<Vec<_>>().join(" + "))
}

/// Loops are told apart up to the last one, and past it nothing is said of another.
#[test]
fn as_many_loops_as_there_are_numbers_for() {
    let derived = |count| derive(&mut many_loops(count), &[Purpose::EnergyAndGradient]);
    let program = derived(LOOPS).expect("as many as there may be");
    let mut starts: Vec<i64> = Vec::new();
    for step in &program.functions[0].evaluation {
        if let Step::Loop(one) = step {
            starts.push(one.start.constant);
        }
    }
    starts.sort_unstable();
    assert_eq!(starts, (0..LOOPS as i64).collect::<Vec<_>>());
    assert_eq!(derived(LOOPS + 1), Err(NoProgram::TooManyLoops));

    // Of more nothing is said: the last loops would be taken for others.
    let mut more = many_loops(LOOPS + 1);
    let h = more.h();
    assert_eq!(bracket(&mut more, h, h), None);
    assert!(matches!(
        is_invariant(&more, h, None),
        Verdict::Undecided { .. }
    ));
    let equations = hamilton_equations(&more).written(Notation::Text);
    assert_eq!(equations[0].1, "∂H/∂p[k]");
}

/// A bound on the size of a power is found before it is built, and an exponent is never rounded.
#[test]
fn powers_are_not_expanded() {
    let verdict = |h: &str, claim: &str| {
        let mut m = system("q; p", "", "", h);
        let claim = parse(&mut m, claim);
        is_invariant(&m, claim, None)
    };
    let undecided = verdict("p^2/2 + (1 + q)^1000", "p^2/2 + (1 + 2*q + q^2)^500");
    assert!(
        matches!(undecided, Verdict::Undecided { .. }),
        "{undecided:?}"
    );
    let h = "(1 + q + p)^300";
    assert!(verdict(h, h).is_proven());
    for power in ["-2147483648", "-2147483647", "9007199254740993"] {
        let h = format!("p^2/2 + q^({power})");
        assert!(verdict(&h, &h).is_proven(), "{power}");
    }
    let mut m = model("q; p", "", "");
    for (power, value) in [
        ("(-1)^9007199254740993", "-1"),
        ("(-1)^9007199254740994", "1"),
    ] {
        let (power, value) = (parse(&mut m, power), parse(&mut m, value));
        assert_eq!(power, value);
    }
}

/// 0 has no reciprocal, so nothing is known of its sign.
#[test]
fn a_reciprocal_of_zero_has_no_sign() {
    let mut m = model("q; p", "", "a");
    for (source, is_nonnegative) in [
        ("0", true),
        ("0^-1", false),
        ("0^-2", false),
        ("-1/0", false),
        ("0^2", true),
        ("q^-2", true),
    ] {
        let node = parse(&mut m, source);
        assert_eq!(m.dag.is_nonnegative(node), is_nonnegative, "{source}");
    }
}
