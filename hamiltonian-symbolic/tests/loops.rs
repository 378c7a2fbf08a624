//! Loops written out are the system they were, and derivatives with respect to element k are the
//! derivatives of the written-out system.

use crate::common::{model, parse, system};
use hamiltonian_symbolic::dag::{Array, Column, Dependence, Kind, Node, Side};
use hamiltonian_symbolic::diff;
use hamiltonian_symbolic::index::{Affine, Domain, Size};
use hamiltonian_symbolic::loops::{Sample, field, sample, unroll, unroll_nodes, unrolled};
use hamiltonian_symbolic::model::{Model, Observable, ObservableKind, Shape};
use hamiltonian_symbolic::print::text;

const SYSTEMS: &[(&str, &str, &str, &str)] = &[
    (
        "q[N]; p[N]",
        "N",
        "",
        "sum(i in 0..N) { p[i]^2/2 + exp(q[i] - q[(i + 1) % N]) }",
    ),
    (
        "q[N]; p[N]",
        "N",
        "",
        "sum(i in 0..N) { p[i]^2/2 + (q[i] - q[(i - 1) % N])^4*cos(q[(i + 2) % N]) }",
    ),
    (
        "q[N][2]; p[N][2]",
        "N",
        "G m[N]",
        "sum(i in 0..N) { (p[i][0]^2 + p[i][1]^2)/(2*m[i]) } - G*sum(i in 0..N, j in 0..i) { m[i]*m[j]/sqrt((q[i][0] - q[j][0])^2 + (q[i][1] - q[j][1])^2 + 1/10) }",
    ),
    (
        "q[N]; p[N]",
        "N",
        "",
        "sum(i in 0..N) { p[i]^2 } + sum(i in 0..N - 1) { sin(q[i + 1] - q[i])*i } + q[0]^2 + q[N - 1]^4",
    ),
    (
        "q[N]; p[N]",
        "N",
        "",
        "sqrt(1 + sum(i in 0..N) { p[i]^2 })*sum(i in 0..N) { q[i]*(i + 1) }",
    ),
    (
        "q[N]; p[N]",
        "N",
        "",
        "sum(i in 0..N) { exp(p[i]/10 + sum(i in 0..N) { q[i] }/10)*q[i] }",
    ),
    (
        "q[N]; p[N]",
        "N",
        "",
        "sum(i in 0..N, j in i + 1..N) { q[i]*p[j]^2*j + cos(q[i]*q[j]) }",
    ),
    (
        "q[N]; p[N]",
        "N",
        "",
        "sum(i in 0..N, j in 0..N) { q[i]*p[j]^2*(i + 2) + sin(q[i] - 2*q[j]) }",
    ),
    (
        "q[N]; p[N]",
        "N",
        "",
        "sum(i in 0..N, j in 0..i + 1, k in 0..j) { q[i]*q[j]^2*p[k] }",
    ),
    (
        "q[N]; p[N]",
        "N",
        "",
        "sum(i in 0..N) { q[N - 1 - i]*p[i]^2 }",
    ),
    (
        "q[N]; p[N]",
        "N",
        "",
        "sum(i in 0..N) { if q[i] < p[i] { q[i]^2*p[i] } else { q[i]*p[i]^2 } }",
    ),
];

fn value(m: &Model, node: Node, size: i64) -> f64 {
    let sizes = vec![size; m.sizes.len()];
    let how = Sample {
        seed: 7,
        signed: true,
        ..Sample::default()
    };
    sample(m, &[node], &sizes, how, &[]).unwrap().0[0].value
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * (1.0 + a.abs() + b.abs())
}

#[test]
fn a_system_written_out_has_the_same_energy() {
    for &(signature, sizes, parameters, h) in SYSTEMS {
        let m = system(signature, sizes, parameters, h);
        for size in [1, 2, 3, 5] {
            let Ok(written) = unroll(&m, &[size]) else {
                panic!("{h} at {size}")
            };
            assert!(
                !written
                    .dag
                    .reachable(&[written.h()])
                    .iter()
                    .any(|n| matches!(
                        written.dag.kind(*n),
                        Kind::Reduce(..) | Kind::Variable(_) | Kind::Extent(_)
                    ))
            );
            assert!(
                close(value(&m, m.h(), size), value(&written, written.h(), size)),
                "{h} at {size}"
            );
        }
    }
}

#[test]
fn written_out_text_is_what_one_would_write() {
    let m = system(
        "q[N]; p[N]",
        "N",
        "a[N]",
        "sum(i in 0..N) { p[i]^2/2 + a[i]*exp(q[i] - q[(i + 1) % N]) }",
    );
    let written = unroll(&m, &[3]).unwrap();
    assert_eq!(
        text(&written, written.h()),
        "p[0]^2/2 + a[0]*exp(q[0] - q[1]) + (p[1]^2/2 + a[1]*exp(q[1] - q[2])) + (p[2]^2/2 + a[2]*exp(q[2] - q[0]))"
    );
    assert_eq!(written.groups[0].shape, Shape::Vector(Affine::constant(3)));
    // One particle in a ring is its own neighbour.
    let alone = unroll(&m, &[1]).unwrap();
    assert_eq!(text(&alone, alone.h()), "p[0]^2/2 + a[0]");
    let none = unroll(&m, &[0]).unwrap();
    assert_eq!(text(&none, none.h()), "0");
}

#[test]
fn what_is_outside_an_array_is_an_error() {
    let m = system(
        "q[N]; p[N]",
        "N",
        "a[3]",
        "sum(i in 0..N) { p[i]^2 + a[i]*q[i] } + q[2]",
    );
    assert_eq!(unroll(&m, &[2]).unwrap_err(), "`q[2]` is outside 0..2");
    assert!(unroll(&m, &[3]).is_ok());
    assert_eq!(unroll(&m, &[4]).unwrap_err(), "`a[3]` is outside 0..3");
    let large = system(
        "q[N]; p[N]",
        "N",
        "",
        "sum(i in 0..N, j in 0..N) { sin(q[i]*p[j]) }",
    );
    assert!(unroll(&large, &[100_000]).is_err());
}

#[test]
fn observables_come_along() {
    let mut m = system("q[N]; p[N]", "N", "", "sum(i in 0..N) { p[i]^2/2 }");
    let components = vec![
        parse(&mut m, "sum(i in 0..N) { p[i] }"),
        parse(&mut m, "N*q[0]"),
    ];
    m.observables.push(Observable {
        name: "both".into(),
        kind: ObservableKind::Monitor,
        components,
    });
    let written = unroll(&m, &[2]).unwrap();
    let texts: Vec<String> = written.observables[0]
        .components
        .iter()
        .map(|c| text(&written, *c))
        .collect();
    assert_eq!(texts, ["p[0] + p[1]", "2*q[0]"]);
    let (small, images) = unroll_nodes(&m, &[3], &[m.observables[0].components[0]]).unwrap();
    assert_eq!(text(&small, images[0]), "p[0] + p[1] + p[2]");
    let mut literal = model("q[2]; p[2]", "", "");
    let sum = parse(&mut literal, "sum(i in 0..2) { q[i]*p[i] }");
    let written = unrolled(&mut literal, sum).unwrap();
    assert_eq!(text(&literal, written), "q[0]*p[0] + q[1]*p[1]");
}

#[test]
fn derivatives_by_element_are_those_of_the_system_written_out() {
    let mut checked = 0;
    for &(signature, sizes, parameters, h) in SYSTEMS {
        for (side, what) in [(Side::Q, Dependence::Q), (Side::P, Dependence::P)] {
            let mut m = system(signature, sizes, parameters, h);
            let root = m.h();
            let leaves = diff::gradient(&mut m.dag, root, what);
            let (rows, columns) = match m.groups[0].shape.clone() {
                Shape::Vector(rows) => (rows, 1),
                Shape::Matrix(rows, _) => (rows, 2),
                Shape::Scalar | Shape::Lattice(..) => panic!(),
            };
            let k = field::elements(&mut m.dag, &rows);
            for column in 0..columns {
                let array = Array::Phase(Column {
                    side,
                    group: 0,
                    column,
                });
                let Some(derivative) = field::field(&mut m.dag, &leaves, array, &rows) else {
                    panic!("{h}")
                };
                for size in [1, 2, 3, 5] {
                    let mut written = unroll(&m, &[size]).unwrap();
                    let root = written.h();
                    let gradient = diff::gradient(&mut written.dag, root, what);
                    for row in 0..size {
                        let at = m.dag.replace(derivative, k, &Affine::constant(row));
                        let found = value(&m, at, size);
                        let expected = gradient
                            .iter()
                            .find(|(leaf, _)| matches!(written.dag.kind(*leaf), Kind::Element(of, index, None) if *of == array && index.affine == Affine::constant(row)))
                            .map_or(0.0, |(_, adjoint)| value(&written, *adjoint, size));
                        assert!(
                            close(found, expected),
                            "{h}: row {row} of {size}: {found} and {expected}: {}",
                            text(&m, derivative)
                        );
                        checked += 1;
                    }
                }
            }
        }
    }
    assert!(checked > 200);
}

/// Values are exact, or none if they need more than 64 bits.
#[test]
fn values_of_affine_forms_are_checked() {
    let (i, n) = (Domain(0), Size(0));
    let form = |k: i64, constant: i64| Affine {
        constant,
        loops: vec![(i, k)],
        sizes: vec![(n, -k)],
        products: vec![(vec![n, n], 3)],
    };
    let value = |form: &Affine, i: i64, n: i64| form.checked_value(&|_| i, &|_| n);
    assert_eq!(value(&form(2, 5), 7, 4), Some(2 * 7 - 2 * 4 + 3 * 16 + 5));
    // Terms may be larger than their sum.
    let large = 1 << 62;
    assert_eq!(value(&form(large, -1), 9, 8), Some(large + 3 * 64 - 1));
    assert_eq!(value(&form(large, 0), 10, 8), None);
    assert_eq!(value(&form(0, 0), 0, 1 << 40), None);
    assert_eq!(value(&form(0, i64::MAX), 0, 0), Some(i64::MAX));
    assert_eq!(value(&form(0, i64::MAX), 0, 1), None);
}
