//! Products with a factor that vanishes: no infinity or NaN of another factor reaches values or derivatives there.
//!
//! Definitions are made at random from factors that vanish where x < 0, and factors that are singular there or at x = 0.
//! The control has a factor that is 0 but not a literal 0, and is NaN.

use crate::common;
use crate::tree::Random;
use hamiltonian_symbolic::dag::{Array, Column, Side};
use hamiltonian_symbolic::interpret::{Point, run};
use hamiltonian_symbolic::pipeline::derive;
use hamiltonian_symbolic::program::{Program, Purpose, Target};

/// Factors that vanish unless 1 < x.
const VANISHING: [&str; 11] = [
    "if x > 1 { 1 } else { 0 }",
    "if x <= 1 { 0 } else { x }",
    "if !(x > 1) { 0 } else { if y > -9 { y } else { x } }",
    "max(x - 1, 0)",
    "max(0, x - 1)^2",
    "min(1 - x, 0)",
    "(1 + sign(x - 1))",
    "((if x > 1 { y } else { 0 }) + (if x > 2 { x } else { 0 }))",
    "(if x > 1 { x } else { 0 })*(if x > 0.5 { y } else { 0 })",
    "sum(i in 0..3) { if x > 1 + i { x + i*y } else { 0 } }",
    "sum(i in 0..3) { max(x - 1 - i, 0)^2*y }^2",
];

/// Factors that are singular, or have a singular derivative, at x = 0 or where x < 0.
const SINGULAR: [&str; 11] = [
    "(sqrt(x^2) - k)^2*sqrt(x^2 + z^2)",
    "sqrt(x^2 + z^2)",
    "(sqrt(x^2 + z^2) - k)^2",
    "sqrt(x)",
    "ln(x)",
    "1/x",
    "x^k",
    "hypot(x, z)",
    "exp(-1000*x)",
    "sqrt(sum(i in 0..3) { x^2 + i*z^2 })",
    "sum(i in 1..3) { ln(i*x)*i }",
];

fn program(h: &str) -> Program {
    let mut model = common::system("x, y, z; px, py, pz", "", "k", h);
    let wanted = [Purpose::Energy, Purpose::Gradient, Purpose::HessianVector];
    derive(&mut model, &wanted).unwrap()
}

/// H, its gradient and its Hessian times a direction.
fn computed(program: &Program, q: [f64; 3]) -> Vec<f64> {
    let mut point = Point::<f64>::new();
    point.scalars = vec![1.5];
    let mut targets = Vec::new();
    for group in 0..3 {
        for side in [Side::Q, Side::P] {
            let column = Column {
                side,
                group,
                column: 0,
            };
            let value = if side == Side::Q {
                q[usize::from(group)]
            } else {
                0.25
            };
            point.arrays.insert(Array::Phase(column), vec![vec![value]]);
            point
                .arrays
                .insert(Array::Direction(column), vec![vec![0.5]]);
            point.outputs.insert(Target::Phase(column), vec![vec![0.0]]);
            targets.push(Target::Phase(column));
        }
    }
    let mut all = Vec::new();
    for function in &program.functions {
        let outcome = run(program, function, &point);
        all.extend(&outcome.results);
        if function.purpose != Purpose::Energy {
            all.extend(targets.iter().map(|target| outcome.outputs[target][0][0]));
        }
    }
    all
}

#[test]
fn a_vanishing_factor_takes_the_product_with_it() {
    let mut random = Random(3802);
    let kinetic = program("(px^2 + py^2 + pz^2)/2");
    let count = common::cases(300, 3_000);
    for _ in 0..count {
        let vanishing = random.one_of(&VANISHING);
        let mut factors = vec![random.one_of(&SINGULAR), random.one_of(&SINGULAR)];
        factors.insert(random.below(3), vanishing);
        let mut product = format!("({})", factors.join(")*("));
        let (n, m) = (random.below(3), random.below(3));
        product = match n {
            0 => format!("({product})"),
            1 => format!(
                "k*({product})*{}",
                random.one_of(&["sin(y)", "y^2", "exp(y)"])
            ),
            _ => format!("({product})/(1 + y^2)"),
        };
        if m == 0 {
            product = format!("(if y > -5 {{ {product} }} else {{ 0 }})");
        }
        let h = format!("(px^2 + py^2 + pz^2)/2 + {product}");
        let program = program(&h);
        for x in [0.0, -0.5, 0.5, -2.0] {
            let q = [x, 0.75, if random.chance(0.5) { 0.0 } else { 1.0 }];
            assert_eq!(computed(&program, q), computed(&kinetic, q), "{h} at {q:?}");
        }
        // Inside the support the product counts.
        let inside = [2.5, 0.75, 1.0];
        assert!(
            computed(&program, inside).iter().all(|x| x.is_finite()),
            "{h}"
        );
        // exp(-2500) is 0.
        if !h.contains("-1000") {
            let (found, without) = (computed(&program, inside), computed(&kinetic, inside));
            assert_ne!(found, without, "{h}");
        }
    }
}

/// A factor that happens to be 0 takes nothing with it: such products are NaN.
#[test]
fn a_product_as_it_stands_is_not_a_number() {
    for (singular, x) in [("sqrt(x^2 + z^2)", 0.0), ("exp(-1000*(x + 1))", -2.0)] {
        let h = format!("px^2/2 + (if x > 1 {{ 1 }} else {{ y }})*{singular}");
        let found = computed(&program(&h), [x, 0.0, 0.0]);
        assert!(found.iter().any(|x| x.is_nan()), "{h}: {found:?}");
    }
}

/// Terms of a sum over a loop that vanish take a factor in front of the sum with them.
#[test]
fn terms_of_sums_vanish_with_their_factors() {
    let h = "p^2/2 + sqrt(q^2)*sqrt(x^2)*sum(i in 0..3) { if i*q > 9 { q^2 } else { 0 } }";
    let mut model = common::system("q, x; p, u", "", "", h);
    let program = derive(&mut model, &[Purpose::Gradient]).unwrap();
    let mut point = Point::<f64>::new();
    for group in 0..2 {
        for side in [Side::Q, Side::P] {
            let column = Column {
                side,
                group,
                column: 0,
            };
            point.arrays.insert(Array::Phase(column), vec![vec![0.0]]);
            point.outputs.insert(Target::Phase(column), vec![vec![1.0]]);
        }
    }
    let outcome = run(&program, &program.functions[0], &point);
    assert!(
        outcome.outputs.values().all(|value| value[0][0] == 0.0),
        "{outcome:?}"
    );
}

/// A NaN of the factor itself stays one.
#[test]
fn a_factor_without_a_value_is_none() {
    let program = program("px^2/2 + max(sqrt(x) - 1, 0)*ln(x)");
    assert!(computed(&program, [-1.0, 0.0, 0.0])[0].is_nan());
}

/// Where one of two sums is 0, the product is, whatever the other sum is.
#[test]
fn each_of_two_vanishing_sums_takes_the_product_with_it() {
    let there = "sum(i in 0..3) { if y > i - 9 { 1 + i } else { 0 } }";
    let gone = "sum(i in 0..3) { if x > 1 + i { x + i*y } else { 0 } }";
    let kinetic = program("(px^2 + py^2 + pz^2)/2");
    for product in [
        format!("ln(x)*({there})*({gone})"),
        format!("ln(x)*({gone})*({there})"),
        format!("ln(x)*({there})^2*({gone})"),
        format!("ln(x)*({gone})*({there})^2"),
        format!("sum(i in 1..3) {{ ln(i*x)*i }}*({there})*({gone})"),
        format!("sum(i in 1..3) {{ ln(i*x)*i }}*({gone})*({there})"),
    ] {
        let h = format!("(px^2 + py^2 + pz^2)/2 + {product}");
        for q in [[0.0, 0.75, 1.0], [-2.0, 0.75, 1.0]] {
            assert_eq!(
                computed(&program(&h), q),
                computed(&kinetic, q),
                "{h} at {q:?}"
            );
        }
    }
}

/// At 0, x/(eˣ − 1) has the derivatives of 1 − x/2 + x²/12, also twice in a product and inside of another such quotient.
#[test]
fn quotients_of_exponentials_are_continued() {
    for (quotients, series) in [
        (
            "x/exp_m1(x)*y/exp_m1(y)",
            "(1 - x/2 + x^2/12)*(1 - y/2 + y^2/12)",
        ),
        (
            "(y*x/exp_m1(x))/exp_m1(y*x/exp_m1(x))",
            "1 - y*(1 - x/2)/2 + y^2/12",
        ),
    ] {
        let of = |v: &str| {
            let program = program(&format!("(px^2 + py^2 + pz^2)/2 + {v}"));
            computed(&program, [0.0, 0.0, 0.0])
        };
        let (found, expected) = (of(quotients), of(series));
        let is_near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-14;
        assert!(
            found.iter().zip(&expected).all(is_near),
            "{quotients}: {found:?} instead of {expected:?}"
        );
    }
}
