//! Numbers with bounds contain the exact value, and what rounding hides decides nothing.

use crate::common::{model, parse, system};
use crate::tree::Random;
use hamiltonian_lanes::{DoubleDouble as D, Real};
use hamiltonian_symbolic::Ball;
use hamiltonian_symbolic::normal_form::{Proof, is_zero};
use hamiltonian_symbolic::op::{Op, TABLE};
use hamiltonian_symbolic::split::exact_flow;
use hamiltonian_symbolic::structure::analyse;

/// A number of any size, often one where functions have an end of their domain, a zero or a jump.
fn number(random: &mut Random) -> f64 {
    let sizes = [1e-300, 1e-17, 1e-6, 0.1, 1.0, 3.0, 40.0, 1e6, 1e17, 1e300];
    let special = [
        0.0,
        1.0,
        -1.0,
        std::f64::consts::PI,
        std::f64::consts::FRAC_PI_2,
    ];
    match random.chance(0.2) {
        true => random.one_of(&special),
        false => random.one_of(&sizes) * (2.0 * random.unit() - 1.0),
    }
}

/// A ball of any relative size.
fn ball(random: &mut Random) -> Ball {
    let value = number(random);
    let sizes = [0.0, 0.0, 1e-16, 1e-9, 1e-3, 0.5];
    let error = random.one_of(&sizes) * value.abs() + random.one_of(&[0.0, 0.0, 1e-12, 0.01]);
    Ball { value, error }
}

/// A number in a ball: an end of it, or anywhere.
fn inside(ball: Ball, random: &mut Random) -> f64 {
    let part = match random.chance(0.4) {
        true => random.one_of(&[-1.0, 1.0, 0.0]),
        false => 2.0 * random.unit() - 1.0,
    };
    let x = ball.value + part * ball.error;
    x.clamp(
        (ball.value - ball.error).next_up().min(ball.value),
        (ball.value + ball.error).next_down().max(ball.value),
    )
}

/// Returns true if a ball holds a number, with so many units of slack as the number's own digits need.
fn holds(ball: Ball, exact: D) -> bool {
    let off = (D::from(ball.value) - exact).abs().to_f64();
    off <= ball.error
}

fn power(x: D, n: i32) -> D {
    let power = (0..n.abs()).fold(D::from(1.0), |power, _| power * x);
    if n < 0 { D::from(1.0) / power } else { power }
}

#[test]
fn balls_hold_the_exact_value() {
    let mut random = Random(4);
    let (mut bounded, mut tight, mut faults) = (0, 0, Vec::new());
    for _ in 0..crate::common::cases(40_000, 2_000_000) {
        let (a, b) = (ball(&mut random), ball(&mut random));
        let (x, y) = (inside(a, &mut random), inside(b, &mut random));
        let (u, v) = (D::from(x), D::from(y));
        let n = random.below(9) as i32 - 4;
        let op = random.one_of(Op::all());
        let (what, found, exact) = match random.below(6) {
            0 => ("sum".to_owned(), a + b, u + v),
            1 => ("product".to_owned(), a * b, u * v),
            2 => (format!("power {n}"), a.powi(n), power(u, n)),
            _ => match TABLE[op as usize].arguments.len() {
                1 => (format!("{op:?}"), Ball::call(op, &[a]), op.eval(&[u])),
                2 => {
                    // Remainders of `f64` are exact, those of double-doubles lose the digits of large quotients. The
                    // sum of one below 0 and a large modulus is not.
                    let exact = match op {
                        Op::Modulo if x % y < 0.0 => D::from(x % y) + D::from(y.abs()),
                        Op::Modulo | Op::Remainder => D::from(op.eval(&[x, y])),
                        _ => op.eval(&[u, v]),
                    };
                    (format!("{op:?}"), Ball::call(op, &[a, b]), exact)
                }
                _ => continue,
            },
        };
        // What has no exact value has no ball, and words of the reference end at the range of doubles.
        let size = exact.to_f64().abs();
        if found.is_defined()
            && (size < 1e290 && (size > 1e-270 || size == 0.0) || !size.is_finite())
        {
            bounded += 1;
            tight += usize::from(found.error <= 1e-9 * size);
            if !holds(found, exact) {
                faults.push(format!(
                    "{what} of {a:?}, {b:?} at {x:e}, {y:e}: {found:?}, {exact:?}"
                ));
            }
        }
    }
    println!("{bounded} bounded, {tight} to nine digits");
    assert!(bounded > 10_000 && tight > 5_000);
    assert!(faults.is_empty(), "{}: {faults:#?}", faults.len());
}

/// The control of the test above: a bound a thousandth as large does not hold.
#[test]
fn smaller_bounds_do_not_hold() {
    let x = Ball {
        value: 0.7,
        error: 1e-9,
    };
    let mut found = Ball::call(Op::Exp, &[x]);
    let exact = D::from(0.7 + 0.999e-9).exp();
    assert!(holds(found, exact));
    found.error *= 1e-3;
    assert!(!holds(found, exact));
}

#[test]
fn what_rounding_hides_is_not_refuted() {
    for zero in [
        "sqrt(2)*sqrt(3) - sqrt(6)",
        "x*sqrt(2)*sqrt(3) - x*sqrt(6)",
        "(x + 10^17) - 10^17 - x",
        "sin(10^15*x)^2 + cos(10^15*x)^2 - 1",
        "sin(10^15*x + y) - sin(10^15*x)*cos(y) - cos(10^15*x)*sin(y)",
        "(x - 10^9)^3 - x^3 + 3*10^9*x^2 - 3*10^18*x + 10^27",
        "exp(x + 600)/exp(600) - exp(x)",
        "(1 + 10^-17)*exp(x) - exp(x) - 10^-17*exp(x)",
        "x - (if sqrt(2)*sqrt(3) < sqrt(6) { y } else { x })",
        "x - (if 10^9*sqrt(2)*sqrt(3) < 10^9*sqrt(6) { y } else { x })",
    ] {
        let mut m = model("x, y; u, v", "", "a");
        let node = parse(&mut m, zero);
        let proof = is_zero(&m, node);
        assert!(!matches!(proof, Proof::NonZero { .. }), "{zero}: {proof:?}");
    }
    for other in [
        "sqrt(2)*sqrt(3) - sqrt(6) + 10^-18",
        "x + 10^-18 - x",
        "x*sqrt(2)*sqrt(3) - x*sqrt(6)*(1 + 10^-17)",
        "(1 + 10^-17)*exp(x) - exp(x)",
        "sin(x + 10^-18) - sin(x)",
        "x - (if x + 10^-18 <= x { y } else { x + 10^-30 })",
    ] {
        let mut m = model("x, y; u, v", "", "a");
        let node = parse(&mut m, other);
        assert_ne!(is_zero(&m, node), Proof::Zero, "{other}");
    }
}

#[test]
fn what_rounding_hides_costs_no_trait() {
    for (h, form) in [
        ("((q + 10^9)^2 - 2*10^9*q - 10^18)*p", "f(q)·p"),
        ("(cos(q + 10^6)^2 + sin(q + 10^6)^2 + q^2)*p", "f(q)·p"),
        ("p^2/2 + (q + 10^8)^2 - 2*10^8*q", "quadratic form"),
        ("(sqrt(2)*sqrt(3) - sqrt(6))*q^3*p^3 + q^2*p", "monomial"),
    ] {
        let mut m = system("q; p", "", "", h);
        let node = m.h();
        let flow = exact_flow(&mut m, node);
        let forms = flow.map(|flow| flow.forms().to_vec());
        assert!(
            forms.as_ref().is_some_and(|forms| forms.contains(&form)),
            "{h}: {forms:?}"
        );
    }
    // What is as small as that is no zero.
    let mut m = system("q; p", "", "", "p^2/2 + q^2/2 + 10^-30*q*p");
    assert!(analyse(&mut m).separable.is_err());
    for h in ["(q^2 + 10^-12*q^3)*p", "p^2/2 + q^2/2 + 10^-17*q^3"] {
        let mut m = system("q; p", "", "", h);
        let node = m.h();
        assert!(exact_flow(&mut m, node).is_none(), "{h}");
    }
}
