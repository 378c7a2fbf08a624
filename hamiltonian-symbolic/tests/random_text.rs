//! Random expressions: text reads back as the expression it was written from, LaTeX is balanced, and no
//! analysis contradicts the numbers or panics.

use crate::common::{model, parse};
use hamiltonian_symbolic::bracket::{Verdict, is_invariant};
use hamiltonian_symbolic::dag::Node;
use hamiltonian_symbolic::loops::{Sample, sample};
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::normal_form::{Proof, is_zero};
use hamiltonian_symbolic::op::{Far, Op};
use hamiltonian_symbolic::print::{Notation, hamilton_equations, latex, text};
use hamiltonian_symbolic::structure::{analyse, expand};

/// A generator that gives the same numbers everywhere (SplitMix64).
pub struct Random(pub u64);

impl Random {
    pub fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) % n as u64) as usize
    }
    pub fn pick<'a>(&mut self, from: &[&'a str]) -> &'a str {
        from[self.below(from.len())]
    }

    fn expression(&mut self, depth: usize, in_loop: bool) -> String {
        if depth == 0 || self.below(12) == 0 {
            let leaves: &[&str] = if in_loop {
                &[
                    "q[i]",
                    "p[i]",
                    "q[(i + 1) % N]",
                    "x",
                    "u",
                    "m",
                    "a[i]",
                    "i",
                    "2",
                    "0.5",
                    "t",
                ]
            } else {
                &[
                    "x", "y", "u", "v", "m", "k", "t", "2", "0.5", "1/3", "q[0]", "p[N - 1]", "N",
                    "pi",
                ]
            };
            return self.pick(leaves).to_owned();
        }
        let inner = |random: &mut Random| random.expression(depth - 1, in_loop);
        match self.below(13) {
            0 | 1 => format!("({}) + ({})", inner(self), inner(self)),
            2 | 3 => format!("({}) - ({})", inner(self), inner(self)),
            4 | 5 => format!("({})*({})", inner(self), inner(self)),
            6 => format!("({})/({})", inner(self), inner(self)),
            7 => format!(
                "({})^{}",
                inner(self),
                self.pick(&["2", "3", "-1", "0.5", "1.5", "-2", "0.3"])
            ),
            8 => format!(
                "{}({})",
                self.pick(&[
                    "sin", "cos", "exp", "sqrt", "abs", "tanh", "ln", "atan", "sign", "cbrt"
                ]),
                inner(self)
            ),
            9 => format!("-({})", inner(self)),
            10 => format!(
                "{}({}, {})",
                self.pick(&["max", "min", "atan2", "hypot", "f"]),
                inner(self),
                inner(self)
            ),
            11 => format!(
                "if {} < {} {{ {} }} else {{ {} }}",
                self.pick(&["x", "u", "m"]),
                self.pick(&["y", "1", "k"]),
                inner(self),
                inner(self)
            ),
            _ if in_loop => format!("({})^2", inner(self)),
            _ => format!(
                "(sum(i in 0..N) {{ {} }})",
                self.expression(depth - 1, true)
            ),
        }
        // An `if` is an operand only in parentheses.
        .replace("(if", "((if")
        .replace("((if", "(if")
    }
}

fn setting() -> Model {
    model("x, y, q[N]; u, v, p[N]; t", "N", "m k a[N] f/2")
}

fn numbers(m: &Model, node: Node) -> Option<f64> {
    let how = Sample {
        seed: 11,
        ..Sample::default()
    };
    let found = sample(m, &[node], &[3], how, &[])?.0[0];
    (found.value.is_finite() && found.error < 1e-9 * (1.0 + found.value.abs()))
        .then_some(found.value)
}

#[test]
fn text_reads_back() {
    let mut random = Random(1);
    let (mut compared, mut same) = (0, 0);
    for _ in 0..3000 {
        let depth = 1 + random.below(5);
        let source = random.expression(depth, false);
        let mut m = setting();
        let node = parse(&mut m, &source);
        let written = text(&m, node);
        let mut other = setting();
        let back = parse(&mut other, &written);
        // The expression read may be flatter than the one written (a sum whose first term is a sum),
        // but only once.
        let again = text(&other, back);
        let mut third = setting();
        let settled = parse(&mut third, &again);
        assert_eq!(text(&third, settled), again, "{source}");
        same += usize::from(again == written);
        if let (Some(a), Some(b)) = (numbers(&m, node), numbers(&other, back)) {
            assert!(
                (a - b).abs() <= 1e-8 * (1.0 + a.abs()),
                "{source} was written {written}: {a} and {b}"
            );
            compared += 1;
        }
        let tex = latex(&m, node);
        assert_eq!(tex.matches('{').count(), tex.matches('}').count(), "{tex}");
        assert_eq!(
            tex.matches("\\left").count(),
            tex.matches("\\right").count(),
            "{tex}"
        );
    }
    assert!(compared > 1000 && same > 2900, "{compared}, {same}");
}

#[test]
fn expansion_and_split_are_the_same_function() {
    let mut random = Random(2);
    let mut split = 0;
    for _ in 0..1500 {
        let source = format!(
            "{} + {}",
            random.expression(3, false),
            random.expression(2, false)
        );
        let mut m = setting();
        let node = parse(&mut m, &source);
        m.hamiltonian = Some(node);
        let Some(expected) = numbers(&m, node) else {
            continue;
        };
        if let Some(terms) = expand(&mut m.dag, node) {
            let nodes: Vec<Node> = terms.iter().map(|term| term.node(&mut m.dag)).collect();
            let sum = m.dag.add(&nodes);
            if let Some(found) = numbers(&m, sum) {
                assert!(
                    (found - expected).abs() <= 1e-7 * (1.0 + expected.abs()),
                    "{source}"
                );
            }
        }
        let structure = analyse(&mut m);
        if let Ok(parts) = structure.separable {
            let sum = m.dag.add(&[parts.kinetic, parts.potential]);
            if let Some(found) = numbers(&m, sum) {
                assert!(
                    (found - expected).abs() <= 1e-7 * (1.0 + expected.abs()),
                    "{source}"
                );
                split += 1;
            }
        }
        assert_eq!(hamilton_equations(&m).written(Notation::Text).len(), 6);
        let _ = hamilton_equations(&m).written(Notation::Latex);
    }
    assert!(split > 50, "{split}");
}

#[test]
fn proofs_do_not_contradict_numbers() {
    let mut random = Random(3);
    let (mut zero, mut other) = (0, 0);
    for _ in 0..1500 {
        let (a, b) = (random.expression(2, false), random.expression(2, false));
        // True wherever defined, and false variants of it.
        let (source, is_true) = match random.below(6) {
            0 => (
                format!("(({a}) + ({b}))^2 - ({a})^2 - 2*({a})*({b}) - ({b})^2"),
                true,
            ),
            1 => (
                format!("({a})/(1 + ({b})^2) - 1/((1 + ({b})^2)/({a}))"),
                true,
            ),
            2 => (
                format!("sin(({a}) + ({b})) - sin({a})*cos({b}) - cos({a})*sin({b})"),
                true,
            ),
            3 => (format!("exp(({a}) - ({b}))*exp({b}) - exp({a})"), true),
            4 => (
                format!("(({a}) + ({b}))^2 - ({a})^2 - 2*({a})*({b})"),
                false,
            ),
            _ => (format!("max({a}, {b}) - ({a})"), false),
        };
        let mut m = setting();
        let node = parse(&mut m, &source);
        match is_zero(&m, node) {
            Proof::Zero => {
                zero += 1;
                for seed in 20..24 {
                    let how = Sample {
                        seed,
                        signed: true,
                        ..Sample::default()
                    };
                    if let Some((values, _)) = sample(&m, &[node], &[4], how, &[]) {
                        assert!(!values[0].is_nonzero(), "{source}");
                    }
                }
            }
            Proof::NonZero { value, .. } => assert!(!is_true, "{source} = {value}"),
            Proof::Undecided => other += 1,
        }
    }
    assert!(
        zero > 700 && other < 300,
        "{zero} proven, {other} undecided"
    );
}

#[test]
fn functions_of_h_are_conserved() {
    let mut random = Random(4);
    let mut proven = 0;
    for _ in 0..150 {
        let h = random.expression(3, false);
        let mut m = setting();
        let node = parse(&mut m, &format!("{h} + u^2"));
        m.hamiltonian = Some(node);
        if text(&m, node).contains('t') {
            continue;
        }
        let square = m.dag.powi(node, 2);
        match is_invariant(&m, square, None) {
            Verdict::Proven(_) => proven += 1,
            Verdict::Undecided { .. } => {}
            Verdict::Jumps { part, .. } => {
                // The larger of two is infinite on one side of a pole of either.
                let words = ["if", "sign", "atan2", "min", "max"];
                // Where its argument is infinite, sin or exp has no limit, or two.
                let function = part.split('(').next().and_then(Op::named);
                let has_no_limit =
                    function.is_some_and(|op| op.row().regularity.far != Far::Infinite);
                let may_jump = has_no_limit || words.iter().any(|word| h.contains(word));
                assert!(may_jump, "{h}: {part}");
            }
            Verdict::Disproven { residual, .. } => panic!("{h}: {residual}"),
            Verdict::NoShell { why } => panic!("{h}: {why}"),
        }
    }
    assert!(proven > 20, "{proven}");
}
