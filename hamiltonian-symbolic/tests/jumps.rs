//! Derivatives do not see jumps: a function constant on both sides of one is not thereby conserved.

use crate::common::{parse, system};
use hamiltonian_symbolic::bracket::{Verdict, is_invariant};
use hamiltonian_symbolic::dag::{Column, Side};
use hamiltonian_symbolic::index::Index;
use hamiltonian_symbolic::model::{Model, VectorEntry};

fn verdict(model: &mut Model, invariant: &str) -> Verdict {
    let node = parse(model, invariant);
    is_invariant(model, node, None)
}

fn accepted(model: &mut Model, invariant: &str) {
    let found = verdict(model, invariant);
    assert!(found.is_proven(), "{invariant}: {found:?}");
}

/// Derivatives vanish on both sides of a jump.
#[test]
fn nothing_is_proven_across_a_jump() {
    let jumps = |m: &mut Model, invariant: &str| match verdict(m, invariant) {
        Verdict::Jumps { part, .. } => part,
        other => panic!("{invariant}: {other:?}"),
    };
    let mut oscillator = system("x, y; u, v; t", "", "", "(u^2 + v^2 + x^2 + y^2)/2");
    for invariant in [
        "sign(x)",
        "if x < y { 1 } else { 2 }",
        "if t < 1 { 1 } else { 2 }",
        "if x < 0 && y < 0 { 1 } else { 2 }",
        "atan2(x, u) - t",
        "floor(x)",
        "round(3*u)",
        "x % 2 - x",
        "remainder(x, 3) - x",
        "floor(t)",
    ] {
        jumps(&mut oscillator, invariant);
    }
    accepted(&mut oscillator, "u^2 + if x < 0 { x^2 } else { x*abs(x) }");
    accepted(&mut oscillator, "max(x^2 + u^2, y^2 + v^2)");
    accepted(&mut oscillator, "floor(x^2 + u^2)*(x*v - y*u) % 3");
    accepted(&mut oscillator, "(x % 1 + floor(x))^2 + u^2");
    accepted(&mut oscillator, "remainder(x*v - y*u, u^2 + x^2)");
    // At q = k the first term is 0, and the pole of the second may be there.
    let mut free = system("q; p", "", "k", "p^2/2");
    jumps(
        &mut free,
        "sign((q - k)^2)^2 + (max(q - 5, 0) - max(5 - q, 0))/(q - 5)",
    );
    accepted(&mut free, "(max(q - 5, 0) - max(5 - q, 0))/(q - 5)");
    // A step of H changes a momentum, and no derivative shows it.
    let mut step = system(
        "x, y; u, v",
        "",
        "",
        "u^2/2 + v^2/2 + if x < 1 { 0 } else { 2 }",
    );
    assert_eq!(jumps(&mut step, "u"), "if x < 1 { 0 } else { 2 }");
    let mut ramp = system(
        "x, y; u, v",
        "",
        "",
        "u^2/2 + v^2/2 + if x < 1 { 0 } else { x - 1 }",
    );
    accepted(&mut ramp, "v");
    // If one element is 0 the sum over all is not: it binds another element.
    let mut saddles = system("x[N]; u[N]", "N", "", "sum(i in 0..N) { x[i]*u[i] }");
    jumps(
        &mut saddles,
        "sum(i in 0..N) { if x[i] < 0 { 0 } else { sum(j in 0..N) { x[j]*u[j] } } }",
    );
    accepted(
        &mut saddles,
        "sum(i in 0..N) { if x[i] < 0 { 0 } else { x[i]*u[i] } }",
    );
}

/// A free particle crosses q = 0, an oscillator every q and p.
#[test]
fn nothing_is_proven_across_a_pole_with_two_sides() {
    let jumps = |m: &mut Model, invariant: &str, part: &str| match verdict(m, invariant) {
        Verdict::Jumps { part: found, .. } => assert_eq!(found, part, "{invariant}"),
        other => panic!("{invariant}: {other:?}"),
    };
    let mut free = system("q, x; p, u; t", "", "a", "p^2/2 + u^2/2");
    for (invariant, part) in [
        ("abs(q)/q", "abs(q)/q"),
        ("q/abs(q)", "q/abs(q)"),
        ("p + sqrt(q^2)/q", "abs(q)/q"),
        ("abs(q - a)/(q - a)", "abs(q - a)/(q - a)"),
        ("q*sqrt(1/q^2)", "q/abs(q)"),
        ("q*exp(-ln(abs(q)))", "exp(-ln(abs(q)))"),
        (
            "sqrt(q^2 + 2*q*x + x^2)/(q + x)",
            "sqrt(q^2 + 2*q*x + x^2)/(q + x)",
        ),
        ("hypot(q, q)/q", "hypot(q, q)/q"),
        ("abs(sin(q))/sin(q)", "abs(sin(q))/sin(q)"),
        ("max(q, 0)/q + max(-q, 0)/q", "max(q, 0)/q"),
        (
            "(if q < 0 { -q } else { q })/q",
            "(if q < 0 { -q } else { q })/q",
        ),
        ("abs(t - 1)/(t - 1)", "abs(t - 1)/(t - 1)"),
        ("atan(1/q) + atan(q)", "atan(1/q)"),
        ("atan(tan(q)) - q + p*t - p*t", "atan(tan(q))"),
        ("abs(q)/q*u", "abs(q)*u/q"),
    ] {
        jumps(&mut free, invariant, part);
    }
    let mut oscillator = system("q; p; t", "", "", "p^2/2 + q^2/2");
    jumps(&mut oscillator, "atan(p/q) + t", "atan(p/q)");
    // A step of H, written as a pole.
    let mut step = system("q, x; p, u", "", "", "p^2/2 + u^2/2 + abs(q)/q");
    jumps(&mut step, "p", "abs(q)/q");
    let mut steps = system(
        "q[N], x; p[N], u",
        "N",
        "",
        "sum(i in 0..N) { p[i]^2/2 + abs(q[i])/q[i] } + u^2",
    );
    jumps(&mut steps, "u", "abs(q[i])/q[i]");
}

/// Poles and kinks that are not in one place, or that nothing crosses, or whose sides agree.
#[test]
fn poles_with_equal_sides_are_no_jumps() {
    let mut squeeze = system("q, x; p, u; t", "", "a", "q*p + u^2/2");
    for invariant in [
        "ln(abs(q)) - t",
        "ln(abs(q)) + ln(abs(p))",
        "abs(q)*abs(p)",
        "abs(q)*p*sqrt(q^2)/q",
        "1/(q*p) + abs(u)",
        "max(q, 0)/q - max(-q, 0)/q",
        "sqrt(1 + u^2)/q/p",
        "abs(q*p)/(1 + u^2)",
    ] {
        accepted(&mut squeeze, invariant);
    }
    let mut kepler = system("x, y; u, v", "", "k", "(u^2 + v^2)/2 - k/sqrt(x^2 + y^2)");
    accepted(&mut kepler, "v*(x*v - y*u) - k*x/sqrt(x^2 + y^2)");
    let mut collinear = system(
        "q[n]; p[n]",
        "n",
        "m[n]",
        "sum(i in 0..n) { p[i]^2/2 } - sum(i in 0..n, j in 0..i) { 1/abs(q[i] - q[j]) }",
    );
    accepted(&mut collinear, "sum(i in 0..n) { p[i] }");
    let mut predators = system("q; p", "", "a b", "q - ln(q) + a*(p - b*ln(p))");
    accepted(&mut predators, "q - ln(q) + a*p - a*b*ln(p)");
}

/// The term that jumps is named, among many that do not.
#[test]
fn one_jump_among_many_poles() {
    let harmless = |n: usize| {
        format!(
            "sum(i in 1..{n}, j in 0..i) {{ (max(q[i] - q[j], 0) - max(q[j] - q[i], 0))/(q[i] - q[j]) }}"
        )
    };
    let free = |n: usize| {
        let h = format!("sum(i in 0..{n}) {{ p[i]^2/2 }}");
        system(&format!("q[{n}]; p[{n}]"), "", "", &h)
    };
    accepted(&mut free(11), &harmless(11));
    accepted(&mut free(24), &harmless(24));
    let last = format!("{} + abs(q[0] - 2*q[10])/(q[0] - 2*q[10])", harmless(11));
    match verdict(&mut free(11), &last) {
        Verdict::Jumps { why, .. } => assert_eq!(
            why,
            "may jump, which no derivative shows; no rule says that both sides agree where `q[0] - 2*q[10]` is 0"
        ),
        other => panic!("{other:?}"),
    }
}

/// sign(0) = 0 is a value too.
#[test]
fn a_value_of_its_own_at_a_jump_counts() {
    let mut free = system("q; p", "", "a", "p^2/2");
    for invariant in [
        "sign(q)^2",
        "2*sign((q - a)^2)^2 + p",
        "if q == 1 { 1 } else { p }",
    ] {
        let found = verdict(&mut free, invariant);
        assert!(
            matches!(found, Verdict::Jumps { .. }),
            "{invariant}: {found:?}"
        );
    }
    accepted(&mut free, "if q == 1 { 1 } else { 1 + p - p }");
    accepted(&mut free, "p + if q == 1 { q - 1 } else { 0 }");
}

/// A force may give energy: H keeps orbits away from nothing then.
#[test]
fn with_a_force_nothing_is_kept_away() {
    let mut well = system("q; p", "", "", "p^2/2 + 1/q^2");
    accepted(&mut well, "sign(q)");
    let drag = parse(&mut well, "-p");
    well.force = vec![VectorEntry {
        at: Column::first(Side::P, 0),
        row: Index::constant(0),
        value: drag,
    }];
    let found = verdict(&mut well, "sign(q)");
    assert!(matches!(found, Verdict::Jumps { .. }), "{found:?}");
    let found = verdict(&mut well, "p^2/2 + 1/q^2");
    assert!(matches!(found, Verdict::Disproven { .. }), "{found:?}");
}

/// H changes its sign at poles and jumps, which are no points of the shell H = 0; a component of the shell that
/// no momentum leads to has points.
#[test]
fn points_of_a_shell_have_its_energy() {
    let on_zero = |h: &str, invariant: &str| {
        let mut model = system("q; p", "", "", h);
        let (node, zero) = (parse(&mut model, invariant), model.dag.integer(0));
        is_invariant(&model, node, Some(zero))
    };
    let found = on_zero("q*p", "p");
    assert!(matches!(found, Verdict::Disproven { .. }), "{found:?}");
    for h in ["p^2/2 - 1/q", "p^2/2 + sign(q)", "p^2/2 + q/(q - 1)"] {
        let found = on_zero(h, &format!("q*({h})"));
        assert!(
            !matches!(found, Verdict::Disproven { .. }),
            "{h}: {found:?}"
        );
    }
}

/// The limit of expressions that are tried is named where it is reached.
#[test]
fn the_limit_of_constants_is_named() {
    let verdict = |count: usize| {
        let steps: Vec<String> = (1..=count).map(|k| format!("sign(p - {k})*{k}")).collect();
        let mut m = system("q; p", "", "", "p^2/2");
        let claim = parse(&mut m, &steps.join(" + "));
        is_invariant(&m, claim, None)
    };
    assert!(verdict(64).is_proven());
    match verdict(65) {
        Verdict::Jumps { why, .. } => assert!(why.ends_with("only 64 are tried"), "{why}"),
        found => panic!("{found:?}"),
    }
}
