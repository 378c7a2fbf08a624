//! The judge on the flows that are known: the cases of the rows, the pieces of the systems, the loops.

use super::field::World;
use super::{Definition, Subject, Verdict, verdicts};
use crate::common;
use crate::splits::arrays::RINGS;
use crate::splits::rows::CASES;
use crate::splits::table::FOUND;
use crate::tree::Random;

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
