//! Expressions that are identically zero are proven so, others are refuted at a point.

use crate::common::{model, parse};
use hamiltonian_symbolic::model::Model;
use hamiltonian_symbolic::normal_form::{Proof, is_zero};

fn scalars() -> Model {
    model(
        "q, x, y, z, r, theta; p, u, v, w, p_r, p_theta; t",
        "",
        "a b M E L f/2 g/1",
    )
}

fn proof(source: &str) -> Proof {
    let mut m = scalars();
    let node = parse(&mut m, source);
    is_zero(&m, node)
}

#[test]
fn identities_are_proven() {
    for source in [
        "(x + y)^3 - x^3 - 3*x^2*y - 3*x*y^2 - y^3",
        "0.1*x + 0.2*x - 0.3*x",
        "sin(x)^2 + cos(x)^2 - 1",
        "sin(x)^4 - cos(x)^4 - sin(x)^2 + cos(x)^2",
        "sin(x - y) - sin(x)*cos(y) + cos(x)*sin(y)",
        "cos(2*x) - 1 + 2*sin(x)^2",
        "sin(3*x) - 3*sin(x) + 4*sin(x)^3",
        "cos(x/2)^2 - (1 + cos(x))/2",
        "sin(x) - 2*sin(x/2)*cos(x/2)",
        "sin(x/2)*cos(x/3) - (sin(5*x/6) + sin(x/6))/2",
        // Arguments that are met before the smallest of the angles.
        "1/(2 + sin(x)) - 1/(2 + 2*sin(x/2)*cos(x/2))",
        "1/(2 + sin(6*x)) - 1/(2 + 2*sin(3*x)*cos(3*x))",
        "exp(1/(2 + cos(4*x))) - exp(1/(1 + 2*cos(2*x)^2))",
        "ln(2 + sin(3*x)) - ln(2 + sin(2*x)*cos(x) + cos(2*x)*sin(x))",
        "1/(2 + exp(x)) - 1/(2 + exp(x/3)*exp(2*x/3))",
        "sin(x + pi/2 - pi/2) - sin(x)",
        "tan(x) - sin(x)/cos(x)",
        "1 + tan(x)^2 - 1/cos(x)^2",
        "1/sin(x)^2 - 1/(1 - cos(x)^2)",
        "1/sin(x)^3 - sin(x)/(1 - cos(x)^2)^2",
        "cosh(x)^2 - sinh(x)^2 - 1",
        "tanh(x) - sinh(x)/cosh(x)",
        "cosh(2*x) - 2*sinh(x)^2 - 1",
        "tanh(x)*(exp(2*x) + 1) - exp(2*x) + 1",
        "exp(x)*exp(y) - exp(x + y)",
        "floor(x + 7/2) - floor(x + 1/2) - 3",
        "round(-x - y) + round(y + x)",
        "x % 2 - (x + 6) % 2",
        "x % a - x + abs(a)*floor(x/abs(a))",
        "x % (-a) - x % a",
        "remainder(x, a) - x + a*round(x/a)",
        "remainder(x, -a) - remainder(x, a)",
        "remainder(-x, a) + remainder(x, a)",
        "exp(3*x) - exp(x)^3",
        "exp(x/2)^2 - exp(x)",
        "exp(x) - exp(x/3)*exp(2*x/3)",
        "exp(x - y)*exp(y - z)*exp(z - x) - 1",
        "exp_m1(x) + 1 - exp(x)",
        "erf(x) + erfc(x) - 1",
        "erf(x - y) + erf(y - x)",
        "erfc(-x) + erfc(x) - 2",
        "sqrt(x)^2 - x",
        "sqrt(4*x) - 2*sqrt(x)",
        "sqrt(2)*sqrt(8) - 4",
        "sqrt(x^2*(y^2 + 1)) - abs(x)*sqrt(y^2 + 1)",
        "1/sqrt(x^2 + y^2)^3*(x^2 + y^2) - 1/sqrt(x^2 + y^2)",
        "hypot(x, y) - sqrt(x^2 + y^2)",
        "x^1.5 - x*sqrt(x)",
        "x^a*x^(1 - a) - x",
        "a^x*a^-x - 1",
        "x^0.25*x^0.75 - x",
        "ln(x*y) - ln(x) - ln(y)",
        "ln(x^3/y) - 3*ln(x) + ln(y)",
        "ln(exp(x)*y) - x - ln(y)",
        "ln(6) - ln(2) - ln(3)",
        "exp(2*ln(x)) - x^2",
        "exp(ln(1 + x^2)/2) - sqrt(1 + x^2)",
        "exp(2*ln(1 + x^2)/3) - cbrt(1 + x^2)^2",
        "ln_1p(x) - ln(1 + x)",
        "asinh(x) - ln(x + sqrt(1 + x^2))",
        "sinh(asinh(x)) - x",
        "atanh(x) - (ln(1 + x) - ln(1 - x))/2",
        "cbrt(x)^3 - x",
        "cbrt(-x) + cbrt(x)",
        "abs(x)^2 - x^2",
        "abs(x)*sign(x) - x",
        "abs(x*y) - abs(x)*abs(y)",
        "sqrt(x^2) - abs(x)",
        "sign(x)^3 - sign(x)",
        "max(x, y) + min(x, y) - x - y",
        "max(x, y)*min(x, y) - x*y",
        "max(x, y) - (if x < y { y } else { x })",
        "(if x < y { x } else { y }) + (if y <= x { x } else { y }) - x - y",
        "(if x < y && x < z { 1 } else { 0 }) - (if x < y { if x < z { 1 } else { 0 } } else { 0 })",
        "(if x < y || x < z { 1 } else { 0 }) + (if !(x < y) && x >= z { 1 } else { 0 }) - 1",
        "1/(1 - x) - 1/(1 + x) - 2*x/(1 - x^2)",
        "1/(1 + 1/x) - x/(x + 1)",
        "(x^2 - y^2)/(x - y) - x - y",
        "1/(x + 1/(y + 1/z)) - (y*z + 1)/(x*y*z + x + z)",
        "(1 + x)^2/(1 + x) - 1 - x",
        "sin(asin(x)) - x",
        "cos(atan2(y, x))*sqrt(x^2 + y^2) - x",
        "sin(2*atan(x)) - 2*x/(1 + x^2)",
        "f(x + x, y) - f(2*x, y)",
        "f(x, y)*g(sin(x)^2) - g(1 - cos(x)^2)*f(x, y)",
        "g((x^2 - 1)/(x + 1)) - g(x - 1)",
        "asin(x) + asin(-x)",
        // Rounding breaks the condition.
        "(if 10^20 + x > 10^20 { x } else { 0 }) - max(x, 0)",
    ] {
        assert_eq!(proof(source), Proof::Zero, "{source}");
    }
}

#[test]
fn what_is_not_zero_is_refuted_at_a_point() {
    for source in [
        "x",
        "sin(x)^2 + cos(x)^2 - 1.0000001",
        "sin(x - y) - sin(x)*cos(y) - cos(x)*sin(y)",
        "exp(x) - 1 - x - x^2/2",
        "1e-12*x",
        "abs(x) - x",
        "ln(x*y) - ln(x)",
        "1/(1 - x) - 1/(1 + x)",
        "f(x, y) - f(y, x)",
        "max(x, y) - y",
        "floor(2*x) - 2*floor(x)",
        "floor(-x) + floor(x)",
        "x % 2 - remainder(x, 2)",
        "x % a - x % b",
        "sqrt(x*x + 1) - x",
        "a - b",
        "t*x",
    ] {
        match proof(source) {
            Proof::NonZero { point, value } => {
                assert!(value != 0.0 && !point.is_empty(), "{source}")
            }
            other => panic!("{source}: {other:?}"),
        }
    }
    match proof("x*a - 2") {
        Proof::NonZero { point, .. } => assert_eq!(
            point
                .iter()
                .map(|(name, _)| name.as_str())
                .collect::<Vec<_>>(),
            ["x", "a"]
        ),
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_is_beyond_the_rules_or_the_budget_is_undecided() {
    for source in [
        // True, but no rule says so.
        "asin(x) + acos(x) - pi/2",
        "sqrt(3 + 2*sqrt(2)) - 1 - sqrt(2)",
        // True, but some 2^30 terms on the way.
        "(x + y + z + q + r + p + u + v)^30*(a - a*sin(x)^2 - a*cos(x)^2)",
        // Nowhere defined.
        "sqrt(-1 - x^2)",
    ] {
        assert_eq!(proof(source), Proof::Undecided, "{source}");
    }
}

/// Conditions on parameters hold at points that are met: nothing is zero but for them.
#[test]
fn where_a_condition_holds_counts() {
    for source in [
        "if a == 1 { x } else { 0 }",
        "if a != 1 { 0 } else { x }",
        "if x == y { 7*x } else { 0 }",
        "sign(a)^2 - 1",
        "sign(a)^2*x*u - x*u",
        "sign(x)^2 - 1",
        "sign(a - b)^2*a - a",
        "sign(sqrt(x)) - 1",
        "sign(x^2 + y^2) - 1",
        "(if a < 1 { x } else { 0 }) + (if a > 1 { x } else { 0 }) - x",
        // The fraction is not felt where its condition does not hold.
        "(if a == 1 { 0 } else { (a^2 - 1)/(a - 1) }) - (a + 1)",
        "(if a^2 == 1 { 0 } else { (a^2 - 1)/(a + 1) }) - (a - 1)",
        "(if a > 0 { 1/a } else { 0 })*a - 1",
        "(if a == 0 { 0 } else { abs(a)^2/a^2 }) - 1",
        "1/(1 + if a > 0 { 1/a } else { 0 }) - a/(a + if a > 0 { 1 } else { 0 })",
    ] {
        assert_ne!(proof(source), Proof::Zero, "{source}");
    }
    for source in [
        "(if a == 1 { x } else { y }) - y - (if a == 1 { 1 } else { 0 })*(x - y)",
        "(if a == b { a*x } else { b*x }) - b*x",
        "(if a == b { sin(a)^2 } else { 1 - cos(a)^2 }) - sin(a)^2",
        "(if a < b { 1 } else { 0 }) + (if a == b { 1 } else { 0 }) + (if a > b { 1 } else { 0 }) - 1",
        "sign(a)^2*a - a",
        "sign(a - b)^2*(a - b)^3 - (a - b)^3",
        "sign(a)^2*sqrt(a) - sqrt(a)",
        "sign(a)^2*cbrt(a) - cbrt(a)",
        "sign(a)^2/a - 1/a",
        "sign(a + b)^2/(a + b) - 1/(a + b)",
        "abs(a - b)^2 - (a - b)^2",
        "abs(a - b)*sign(a - b) - a + b",
        "sign(abs(a)) - sign(a)^2",
        "sign(a^2 + b^2)*(a^2 + b^2) - a^2 - b^2",
        "sign(1 + a^2) - 1",
        "sign(exp(a)) - 1",
        "abs(a)*sqrt(a^2) - a^2",
        "1/abs(a)^2 - 1/a^2",
        "a/abs(a) - sign(a)",
        "(if a != 0 { 1/a } else { 0 })*a - sign(a)^2",
        "(if a == 1 { 0 } else { (a^2 - 1)/(a - 1) }) - (a + 1)*(if a == 1 { 0 } else { 1 })",
        "(if a == 0 { x } else { (sin(x)^2 + cos(x)^2)/a }) - (if a != 0 { 1/a } else { x })",
    ] {
        assert_eq!(proof(source), Proof::Zero, "{source}");
    }
}

#[test]
fn loops_are_linear_and_literal_ones_are_written_out() {
    let mut m = model("q[N], s[4]; p[N], u[4]", "N", "m[N]");
    for source in [
        "sum(i in 0..N) { p[i] + q[i] } - sum(i in 0..N) { p[i] } - sum(i in 0..N) { q[i] }",
        "sum(i in 0..N) { (p[i] + q[i])^2 - 2*p[i]*q[i] } - sum(i in 0..N) { p[i]^2 + q[i]^2 }",
        "sum(i in 0..N) { sin(q[i])^2*m[i] + cos(q[i])^2*m[i] } - sum(i in 0..N) { m[i] }",
        "sum(i in 0..N, j in 0..N) { q[i]*p[j] } - sum(i in 0..N) { q[i] }*sum(i in 0..N) { p[i] }",
    ] {
        let node = parse(&mut m, source);
        assert_eq!(is_zero(&m, node), Proof::Zero, "{source}");
    }
    let node = parse(
        &mut m,
        "sum(i in 0..N) { q[i] } - sum(i in 0..N) { q[(i + 1) % N]^2 }",
    );
    match is_zero(&m, node) {
        Proof::NonZero { point, .. } => assert_eq!(point[0], ("N".to_owned(), 3.0)),
        other => panic!("{other:?}"),
    }
    let triangle = parse(&mut m, "sum(i in 0..N, j in 0..i) { sin(q[i] - q[j]) }");
    assert!(matches!(is_zero(&m, triangle), Proof::NonZero { .. }));
    let mut m = model("s[4]; u[4]", "", "");
    let node = parse(
        &mut m,
        "sum(i in 0..4) { s[i]*u[(i + 1) % 4] } - sum(i in 0..4) { s[(i + 3) % 4]*u[i] }",
    );
    assert_eq!(is_zero(&m, node), Proof::Zero);
}

#[test]
fn elements_at_fixed_indices_take_sizes_at_which_they_exist() {
    let mut m = model("q[n]; p[n]", "n", "a k[50]");
    let nodes = ["q[100]^a", "q[100]^a*k[n]"].map(|source| parse(&mut m, source));
    let [far, nowhere] = nodes.map(|node| is_zero(&m, node));
    assert!(matches!(far, Proof::NonZero { .. }), "{far:?}");
    // q[100] needs n > 100, and k[n] needs n < 50.
    assert_eq!(nowhere, Proof::Undecided);
}
