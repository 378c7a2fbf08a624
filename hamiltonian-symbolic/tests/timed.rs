//! Where H is finite without being evaluated, and where it jumps in time.

use crate::common::system;
use hamiltonian_symbolic::dag::{Kind, Node, Relation, Side};
use hamiltonian_symbolic::jumps::jumps;
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::structure::growth;
use std::collections::BTreeMap;

/// A linear congruential generator of numbers from 0 to 1.
struct Numbers(u64);

impl Numbers {
    fn part(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
    fn below(&mut self, n: usize) -> usize {
        (self.part() * n as f64) as usize
    }
}

/// A random function of (q, p, t) of a depth, as text.
fn random(numbers: &mut Numbers, depth: u32) -> String {
    if depth == 0 {
        return ["q", "p", "t"][numbers.below(3)].to_owned();
    }
    let choice = numbers.below(17);
    let a = random(numbers, depth - 1);
    let mut b = || random(numbers, depth - 1);
    match choice {
        0..=2 => format!("({a} + 2*{})", b()),
        3..=4 => format!("({a}*{})", b()),
        5 => format!("({a})^2"),
        6 => format!("cos({a})"),
        7 => format!("tanh({a})"),
        8 => format!("sqrt(1 + ({a})^2)"),
        9 => format!("1/(2 + ({a})^2)"),
        10 => format!("abs({a})"),
        11 => format!("(if {a} < 1 {{ {} }} else {{ t }})", b()),
        12 => format!("exp({a})"),
        13 => format!("ln({a})"),
        14 => format!("sqrt({a})"),
        15 => format!("(1e180*floor({a}))"),
        _ => format!("1/({a})"),
    }
}

/// H at a point (q, p, t).
fn value(model: &Model, z: &[f64; 3]) -> f64 {
    let dag = &model.dag;
    let mut known: BTreeMap<Node, f64> = BTreeMap::new();
    for node in dag.reachable(&[model.h()]) {
        let of = |node: &Node| known[node];
        let holds = |condition: bool| f64::from(u8::from(condition));
        let value = match dag.kind(node) {
            Kind::Constant(c) => c.to_f64(),
            Kind::Time => z[2],
            Kind::Element(..) => {
                let (column, _) = dag.phase_place(node).expect("a coordinate or a momentum");
                z[usize::from(column.side == Side::P)]
            }
            Kind::Sum(c, terms) => {
                let terms = terms.iter().map(|(k, term)| k.to_f64() * of(term));
                c.to_f64() + terms.sum::<f64>()
            }
            Kind::Product(k, factors) => {
                let powers = factors.iter().map(|(base, n)| of(base).powi(*n));
                k.to_f64() * powers.product::<f64>()
            }
            Kind::Call(op, x) => {
                let x: Vec<f64> = x.iter().map(of).collect();
                op.eval(&x)
            }
            Kind::Compare(Relation::Less, a, b) => holds(of(a) < of(b)),
            Kind::Compare(_, a, b) => holds(of(a) <= of(b)),
            Kind::Not(a) => 1.0 - of(a),
            Kind::Select(condition, yes, no) => of(if of(condition) == 1.0 { yes } else { no }),
            other => panic!("{other:?}"),
        };
        known.insert(node, value);
    }
    known[&model.h()]
}

/// The growth of H as text.
fn growth_of(h: &str) -> Option<u32> {
    let model = system("q; p; t", "", "a", h);
    growth(&model.dag, model.h())
}

#[test]
fn functions_whose_growth_is_known_are_finite() {
    let mut numbers = Numbers(38);
    let (mut known, mut wild) = (0, 0);
    for _ in 0..1200 {
        let depth = 1 + numbers.below(4) as u32;
        let h = random(&mut numbers, depth);
        let model = system("q; p; t", "", "a", &h);
        let found = growth(&model.dag, model.h());
        let most = 600.0 / f64::from(found.unwrap_or(4).max(1));
        let mut is_finite = true;
        for _ in 0..40 {
            let z = [(); 3].map(|()| {
                let sign = if numbers.part() < 0.5 { -1.0 } else { 1.0 };
                sign * (most * (1.0 - 1.2 * numbers.part().powi(2)))
                    .exp2()
                    .min(0.99 * most.exp2())
            });
            is_finite &= value(&model, &z).is_finite();
        }
        match found {
            Some(_) => assert!(is_finite, "{h}: {found:?}"),
            None => wild += u32::from(!is_finite),
        }
        known += u32::from(found.is_some());
    }
    // Among those of unknown growth, many are not finite: the generator makes both kinds.
    assert!(
        known > 400 && wild > 150,
        "{known} known, {wild} not finite"
    );
}

#[test]
fn growth_is_the_largest_power() {
    for (h, power) in [
        ("p^2/2 - cos(q)", Some(2)),
        ("p^2/(2*a) + a*q^4", Some(4)),
        ("p^2/2 + q^8 + sqrt(1 + q^2)", Some(8)),
        ("p^2/2 + q^9", None),
        ("p^2/2 - ln(q)", None),
        ("p^2/2 + sqrt(q)^2", None),
        ("p^2/2 + exp(q)", None),
        ("p^2/2 + 1/q", None),
        ("p^2/2 + 1e12*floor(q)", Some(2)),
        ("p^2/2 + 1e300*floor(q)", None),
        ("p^2/2 + 1/(1e-300 + q^2)^2", None),
        ("p^2/2 + 1/(2 + q^2)^2", Some(2)),
        ("p^2/2 + floor(q)/1e-300", None),
        ("p^2/2 + if q < 0 { 1e200 } else { 0 }", None),
        ("p^2/2 + q^2/(1 + q^2)", Some(2)),
        ("p^2/2 + if q < 0 { q^2 } else { 0 }", Some(2)),
        // The start may not show that a is 0.
        ("p^2/2 + if q < 0 { q/a } else { 0 }", None),
    ] {
        assert_eq!(growth_of(h), power, "{h}");
    }
}

/// Factors that jump at times that do not depend on the state, and factors that do not.
const JUMPING: [&str; 9] = [
    "(2 + floor(a*t))",
    "(7 + remainder(t, 2))",
    "(if t < 1 { 1 } else { 3 })",
    "(if t <= a { 2 } else { t + 7 })",
    "(if 0 < sin(a*t) { cos(t) } else { 5 })",
    "(3 + sign(t - a))",
    "(if t < 1 || t > 2 { t } else { 0.5 })",
    "(if t < 1 && q < 2 { 4 } else { 1 })",
    "(if 1 < t^2 { if q < 1 { 3 } else { 2 } } else { 5 })",
];
const STEADY: [&str; 9] = [
    "cos(a*t)",
    "(if t < 1 { t } else { 1 })",
    "(if t < a { t^2 } else { a^2 })",
    "max(t, a)",
    "abs(t - 1)",
    "(if q < t { 2 } else { 1 })",
    "(2 + sign(q - t))",
    "1/(t^2 + 1)",
    "(if a < 1 { t } else { 2 })",
];
/// Factors of the state around which a factor of time stands.
const STATES: [&str; 5] = ["q^2", "p^2", "cos(q)", "q*p", "(q + p)^4"];

#[test]
fn jumps_at_times_without_the_state_are_found() {
    let mut numbers = Numbers(381);
    let mut counts = [0; 2];
    for case in 0..400 {
        let mut terms = vec!["p^2/2".to_owned()];
        let mut expected = false;
        for _ in 0..1 + numbers.below(3) {
            let is_jumping = numbers.part() < 0.35;
            let factor = match is_jumping {
                true => JUMPING[numbers.below(JUMPING.len())],
                false => STEADY[numbers.below(STEADY.len())],
            };
            let state = STATES[numbers.below(STATES.len())];
            let term = match numbers.below(5) {
                0 => format!("sin({factor}*{state})"),
                1 => format!("({factor} + 1)^2*{state}"),
                2 => format!("sqrt(2 + {state}^2*{factor}^2)"),
                3 => format!("(if q < 5 {{ {factor}*{state} }} else {{ 0 }})"),
                _ => format!("{factor}*{state}"),
            };
            terms.push(term);
            expected |= is_jumping;
        }
        // What depends on time alone moves nothing.
        if numbers.part() < 0.3 && !terms.iter().any(|term| term.contains("q < 2")) {
            terms.push(JUMPING[numbers.below(4)].to_owned());
        }
        let h = terms.join(" + ");
        let mut model = system("q; p; t", "", "a", &h);
        let root = model.h();
        assert_eq!(jumps(&mut model.dag, root), expected, "case {case}: {h}");
        counts[usize::from(expected)] += 1;
    }
    assert!(counts.iter().all(|n| *n > 100), "{counts:?}");
}
