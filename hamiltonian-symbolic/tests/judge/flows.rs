//! The judge on the flows that are known: the cases of the forms, the pieces of the systems, the loops.

use super::field::World;
use super::{Definition, Subject, Verdict, verdicts};
use crate::common;
use crate::splits::arrays::RINGS;
use crate::splits::forms::CASES;
use crate::splits::table::FOUND;
use crate::tree::Random;
use hamiltonian_lanes::{DoubleDouble, Real};

/// The wrong verdicts on definitions, with the number of right ones and the definitions whose flow is
/// missing somewhere.
pub fn wrong(
    definitions: &[Definition],
    subject: impl Fn(&Definition) -> Option<Subject>,
    points: usize,
    zeros: f64,
) -> (Vec<String>, usize, Vec<String>) {
    let (mut wrong, mut right, mut missing) = (Vec::new(), 0, Vec::new());
    for definition in definitions {
        let mut random = Random(definition.h.len() as u64 + 17 * definition.n as u64);
        let Some(subject) = subject(definition) else {
            continue;
        };
        let all = verdicts(&subject, points, zeros, &mut random);
        right += all.iter().filter(|v| **v == Verdict::Right).count();
        let mut gaps = Vec::new();
        for verdict in &all {
            if let Verdict::Missing(place) = verdict {
                gaps.push(place);
            }
        }
        if let Some(first) = gaps.first() {
            let (gaps, n, h) = (gaps.len(), definition.n, &definition.h);
            missing.push(format!("{gaps} of {}: {h} (n = {n}) at {first}", all.len()));
        }
        let first = all.into_iter().find_map(|verdict| match verdict {
            Verdict::Wrong(why) => Some(why),
            _ => None,
        });
        if let Some(why) = first {
            wrong.push(format!("{} (n = {}): {why}", definition.h, definition.n));
        }
    }
    (wrong, right, missing)
}

#[test]
fn rows_end_where_orbits_do() {
    let definitions: Vec<Definition> = CASES
        .iter()
        .map(|case| Definition::of(case.signature, case.parameters, case.h, 0))
        .collect();
    let points = common::cases(4, 200);
    let (wrong, right, missing) = wrong(&definitions, Subject::whole, points, 0.04);
    println!("{right} right; missing: {missing:#?}");
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(right > 2 * CASES.len());
}

#[test]
fn pieces_of_systems_end_where_orbits_do() {
    let definitions: Vec<Definition> = FOUND
        .iter()
        .map(|found| Definition::of(found.signature, found.parameters, found.h, 0))
        .collect();
    let points = common::cases(1, 40);
    let (wrong, right, missing) = wrong(&definitions, Subject::split, points, 0.04);
    println!("{right} right; missing: {missing:#?}");
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(right > FOUND.len());
}

#[test]
fn loops_end_where_orbits_do() {
    let mut definitions = Vec::new();
    for ring in RINGS {
        for n in 1..=4 {
            definitions.push(Definition::of(ring.signature, ring.parameters, ring.h, n));
        }
    }
    let points = common::cases(1, 40);
    let (wrong, right, missing) = wrong(&definitions, Subject::split, points, 0.04);
    println!("{right} right; missing: {missing:#?}");
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(right > RINGS.len());
}

/// H with one kink, with powers that are parameters, with time, and rings whose neighbours coincide at small
/// sizes.
const OTHERS: &[(&str, &str, &str)] = &[
    ("q; p", "", "abs(q*p)"),
    ("q; p", "", "(q*p)^(1/3)"),
    ("q; p", "a", "(q*p)^a"),
    ("q; p", "", "abs(q - p)"),
    ("q; p", "", "abs(q^2 + p^2 - 1)"),
    ("q; p", "", "(q^2 + p^2)^(3/2)"),
    ("q; p", "", "if q^2 + p^2 < 1 { q^2 + p^2 } else { 1 }"),
    ("q; p", "", "atan(p/q)"),
    ("q; p", "a", "p*(q^2 + a)"),
    ("q; p", "a", "p*(q^2 - a^2)"),
    ("q; p", "a", "p^2*(a - q^2)"),
    ("q; p; t", "a", "sin(a*t)*q*p + q^2"),
    ("q; p; t", "", "(q*t + 1)*p"),
    ("x, y; u, v", "", "abs(x*v - y*u)"),
    ("x, y; u, v", "", "max(x*v - y*u, 0)"),
    ("x, y; u, v", "", "sign(x*v - y*u)*(x*v - y*u)^2"),
    ("x, y; u, v", "", "abs(x)*v + x*u"),
    ("q[n]; p[n]", "", "sum(i in 0..n) { q[i]*p[(i + 2) % n] }"),
    (
        "q[n]; p[n]",
        "",
        "sum(i in 0..n) { q[i]^2*p[(i + 1) % n]^2 }",
    ),
    (
        "q[n]; p[n]",
        "",
        "sum(i in 0..n) { q[i]^2 + q[i]*p[(i + 1) % n] }",
    ),
    (
        "q[n]; p[n]",
        "",
        "sum(i in 0..n) { sin(q[i])*cos(p[(i + 1) % n]) }",
    ),
    (
        "q[n]; p[n]",
        "",
        "sum(i in 0..n) { (q[i] + p[(i + 1) % n])^3 }",
    ),
    (
        "q[n]; p[n]",
        "",
        "sum(i in 0..n) { abs(q[(i + 3) % n]*p[i]) }",
    ),
];

#[test]
fn other_flows_end_where_orbits_do() {
    let mut definitions = Vec::new();
    for (signature, parameters, h) in OTHERS {
        let sizes = if signature.contains('n') {
            1..=4
        } else {
            0..=0
        };
        definitions.extend(sizes.map(|n| Definition::of(signature, parameters, h, n)));
    }
    let points = common::cases(4, 200);
    let (wrong, right, missing) = wrong(&definitions, Subject::split, points, 0.04);
    println!("{right} right; missing: {missing:#?}");
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(right > 2 * OTHERS.len());
}

/// Where ψ = 0, a turn about the first body axis goes through the pole of the chart. Beside ψ = 0 all angles
/// jump near there, to other names of one rotation: those of ψ = 0 are the ones of ψ > 0.
#[test]
fn body_axes_pass_the_pole() {
    let h = "((pf - pp*cos(th))*sin(ps)/sin(th) + pt*cos(ps))^2/2";
    let definition = Definition::of("f, th, ps; pf, pt, pp", "", h, 0);
    let subject = Subject::whole(&definition).expect("it has a flow");
    let end = |psi: f64| {
        let z = [-0.8, 0.8, psi, -0.3, 1.0, 1.0];
        subject.act(0, &World::default(), &z, -1.5, false)
    };
    let (there, beside) = (end(0.0), end(1e-9));
    assert!(there[2] > 3.0, "it passes: {there:?}");
    for (a, b) in there.iter().zip(&beside) {
        assert!((a - b).abs() < 1e-7, "{there:?} is not {beside:?}");
    }
}

/// Sums of sums, whose loops have no element in common; the second ones have a flow for sizes that are known.
const APART: &[(&str, &str, &str)] = &[
    (
        "q[n][2], w[3][2]; p[n][2], u[3][2]",
        "k",
        "sum(i in 0..n) { (p[i][0]^2 + p[i][1]^2)/2 - k/sqrt(q[i][0]^2 + q[i][1]^2) }
         + sum(j in 0..3) { (u[j][0]^2 + u[j][1]^2)/2 - k/sqrt(w[j][0]^2 + w[j][1]^2) }",
    ),
    (
        "q[n]; p[n]",
        "a m[n]",
        "sum(i in 0..2) { p[i]^2*q[i]^2*m[i] } + sum(i in 2..n) { a*p[i]^2/2 + q[i]^2/2 + q[i] } + a",
    ),
    (
        "q[n], x, y, w[3]; p[n], u, v, z[3]",
        "a",
        "sum(i in 0..n) { q[i]^2*p[i] } + x*v*a - y*u*a + sum(j in 0..3) { cos(w[j])*z[j] } + 2",
    ),
    (
        "q[n], w[2]; p[n], u[2]",
        "k m[n]",
        "k*(sum(i in 0..n) { m[i]*q[i]*p[i] } + 2*sum(j in 0..2) { w[j]^2 + u[j]^2 })",
    ),
];

#[test]
fn sums_of_sums_end_where_orbits_do() {
    let mut definitions = Vec::new();
    for (signature, parameters, h) in APART {
        let least = if h.contains("2..n") { 2 } else { 1 };
        definitions.extend((least..=4).map(|n| Definition::of(signature, parameters, h, n)));
    }
    for definition in &definitions {
        assert!(Subject::whole(definition).is_some(), "{}", definition.h);
    }
    let points = common::cases(8, 80);
    let (wrong, right, missing) = wrong(&definitions, Subject::whole, points, 0.0);
    println!("{right} right; missing: {missing:#?}");
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(right > 2 * definitions.len());
}

/// Loops that may have an element in common are not one flow.
#[test]
fn sums_with_common_elements_are_no_flow() {
    for h in [
        "sum(i in 0..2) { q[i]^2*p[i] } + sum(i in 1..n) { q[i]*p[i]^2 }",
        "sum(i in 0..n) { q[i]^2*p[i] } + sum(i in 0..3) { w[i]^2*z[i]*q[i] }",
        "sum(i in 0..n) { q[i]^2*p[i] } + sum(i in 0..3) { w[i]*z[i]*q[0] }",
        "sum(i in 0..n) { q[i]^2*p[i] } + sum(i in 0..3) { w[0]^2*z[i] + w[i]*z[0] }",
        "sum(i in 0..n) { q[i]^2*p[i] } + w[0]*z[0]*p[1]",
    ] {
        let definition = Definition::of("q[n], w[3]; p[n], z[3]", "", h, 4);
        assert!(Subject::whole(&definition).is_none(), "{h}");
    }
}

/// H with fixed points at which a formula might divide by 0.
const RESTING: &[(&str, &str, &str)] = &[
    ("q; p", "a b c", "(a*q^2 + b*q^3 + c*q^4)*p^2"),
    ("q; p", "a b", "(a*q^3 + b*q^4)*p^2"),
    ("q; p", "a", "(a*p^2 + p^4)*q^2"),
    ("q; p", "", "(q^2 + q^4)*p^2"),
    ("q; p", "", "(q^2 + q^3 + 2*q^4)*p^2/3"),
    ("q; p", "", "(q^2 - q^4)*p^2"),
    ("q; p", "", "(2*q^3 + q^4)*p^2"),
    ("q; p", "", "(q^3 - 2*q^2)*p^2"),
    ("q; p", "a b c", "exp(-(a*q^2 + b*q^3 + c*q^4)*p^2)"),
    ("x, y; u, v", "", "(x*v - y*u)^2"),
    ("x, y; u, v", "a", "exp(a*(x*v - y*u))"),
    ("x, y; u, v", "", "(x*v - y*u)*(x^2 + y^2)"),
    ("x, y; u, v", "", "sin(x*v - y*u + x^2 + y^2)"),
    (
        "x, y; u, v",
        "a",
        "a*x*v/sqrt(x^2 + y^2 + 1) - a*y*u/sqrt(x^2 + y^2 + 1)",
    ),
    (
        "x, y, z; u, v, w",
        "",
        "x*v/(x^2 + y^2 + z^2) - y*u/(x^2 + y^2 + z^2)",
    ),
    ("x, y; u, v", "", "x^2*v^2 + y^2*u^2 - 2*x*y*u*v"),
    ("r, f; p, L", "", "p^2/2 + L^2/(2*r^2)"),
    ("r, f; p, L", "k", "p^2/2 + (L^2 + k)/(2*r^2)"),
    ("th, f; p, L", "", "p^2/2 + L^2/(2*sin(th)^2)"),
    ("th; p", "k", "p^2/2 + k^2/(2*sin(th)^2)"),
    ("l, g; L, G", "A", "sqrt(G^2 - L^2)*cos(l)/A"),
    ("l, g; L, G", "A", "(G^2 - L^2)*sin(l)^2/(2*A)"),
];

/// Fixed points of H at which its flow has no value or moves, with the number of fixed points that were met; `None` if
/// no flow is found.
fn moved_from_rest(definition: &Definition) -> Option<(Vec<String>, usize)> {
    let subject = Subject::whole(definition)?;
    let velocity = Subject::velocity(definition);
    let mut random = Random(11 + definition.h.len() as u64);
    let (mut faults, mut count) = (Vec::new(), 0);
    for _ in 0..common::cases(200, 2000) {
        let world = subject.world(&mut random);
        let z = subject.resting(&mut random);
        let moves = |of: &Subject, c: f64| {
            let end = of.act(0, &world, &z, DoubleDouble::from(c), false);
            let stays = |(a, b): (&DoubleDouble, &DoubleDouble)| (*a - *b).to_f64().abs() < 1e-24;
            (!end.iter().zip(&z).all(stays)).then_some(end)
        };
        // There is no spin whose component L is longer than it is.
        let is_no_spin = definition.h.contains("G^2 - L^2") && z[2] * z[2] > z[3] * z[3];
        if is_no_spin || moves(&velocity, 1.0).is_some() {
            continue;
        }
        count += 1;
        for c in [0.375, -1.25] {
            if let Some(end) = moves(&subject, c) {
                let [z, end] = [&z, &end].map(|z| z.iter().map(|x| x.to_f64()).collect::<Vec<_>>());
                let (h, parameters) = (&definition.h, &world.parameters);
                faults.push(format!("{h}: {z:?} ends at {end:?}, {parameters:?}"));
            }
        }
    }
    Some((faults, count))
}

/// A fixed point of H is one of each flow: the formula of a form may divide by what is 0 there.
#[test]
fn flows_rest_at_fixed_points() {
    let cases = CASES
        .iter()
        .map(|case| (&case.signature, &case.parameters, &case.h));
    let others = OTHERS
        .iter()
        .chain(RESTING)
        .map(|(signature, parameters, h)| (signature, parameters, h));
    let (mut wrong, mut met, mut resting) = (Vec::new(), 0, 0);
    for (signature, parameters, h) in cases.chain(others) {
        if signature.contains('n') {
            continue;
        }
        let Some((faults, count)) = moved_from_rest(&Definition::of(signature, parameters, h, 0))
        else {
            continue;
        };
        wrong.extend(faults.into_iter().take(2));
        met += usize::from(count > 0);
        let is_resting = RESTING.iter().any(|(_, _, other)| h == other);
        resting += usize::from(is_resting && count > 0);
    }
    assert!(wrong.is_empty(), "{} {wrong:#?}", wrong.len());
    assert_eq!(resting, RESTING.len());
    assert!(met > 40, "{met}");
}
