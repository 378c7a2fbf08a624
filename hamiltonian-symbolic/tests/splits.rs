//! Exact flows of pieces: that they are flows, of the right vector field, symplectic, and end
//! where the orbit does.

pub mod arrays;
mod perturbed;
pub mod table;

use crate::common;
use crate::eval::{Point, run};
use crate::flows::{Case, check};
use crate::tree::{Random, grow};
use hamiltonian_lanes::{DoubleDouble, Real};
use hamiltonian_symbolic::dag::{Column, Side};
use hamiltonian_symbolic::op::Op;
use hamiltonian_symbolic::pipeline::derive;
use hamiltonian_symbolic::program::{Purpose, Target};
use hamiltonian_symbolic::rational::Rational;
use hamiltonian_symbolic::split::{NODES, Refusal, exact_flow, find};
use hamiltonian_symbolic::transform::check_split;
use table::{FOUND, Found, REFUSED};

#[test]
fn rows_take_their_patterns_and_flow() {
    let fails = |case: &&Case| std::panic::catch_unwind(|| check(case)).is_err();
    let failed: Vec<&str> = CASES.iter().filter(fails).map(|case| case.h).collect();
    assert!(failed.is_empty(), "{failed:#?}");
}

pub const CASES: &[Case] = &[
    // Scaled coordinates.
    Case {
        signature: "x, y; px, py",
        parameters: "k",
        h: "k*(2*x*py - y*px/2)/sqrt(4*x^2 + y^2)",
        rows: "rotation",
    },
    Case {
        signature: "l; L",
        parameters: "C",
        h: "sqrt(C^2 - L^2/4)*cos(2*l)",
        rows: "spin component",
    },
    Case {
        signature: "f, th, ps; pf, pt, pp",
        parameters: "A",
        h: "((pf/2 - 3*pp*cos(3*th/2))*sin(ps/3)/sin(3*th/2) + 2*pt*cos(ps/3)/3)^2/(2*A)",
        rows: "body axis",
    },
    Case {
        signature: "f, th, ps; pf, pt, pp",
        parameters: "A",
        h: "((pf - pp*cos(th))*sin(ps)/sin(th) + pt*cos(ps))^2/(2*A)",
        rows: "body axis",
    },
    Case {
        signature: "f, th, ps; pf, pt, pp",
        parameters: "B",
        h: "((pf - pp*cos(th))*cos(ps)/sin(th) - pt*sin(ps))^2/(2*B)",
        rows: "body axis",
    },
    Case {
        signature: "q; p",
        parameters: "",
        h: "0.5*(q^2 + p^2) + 0.5",
        rows: "quadratic form",
    },
    Case {
        signature: "q; p",
        parameters: "k m",
        h: "p^2/(2*m) + k*q^2/2 + k*q",
        rows: "quadratic form",
    },
    Case {
        signature: "q, x; p, y",
        parameters: "",
        h: "(p - q^3)*x*y",
        rows: "shear",
    },
    Case {
        signature: "q; p",
        parameters: "",
        h: "0.5*q^2*p^2",
        rows: "monomial",
    },
    Case {
        signature: "q; p",
        parameters: "a",
        h: "a*q*p^2",
        rows: "monomial",
    },
    Case {
        signature: "r; p_r",
        parameters: "",
        h: "-p_r^2/r",
        rows: "monomial",
    },
    Case {
        signature: "q; p",
        parameters: "",
        h: "q^3*p^5/7",
        rows: "monomial",
    },
    Case {
        signature: "q; p",
        parameters: "",
        h: "0.5*q^2*(p^2 + 1)",
        rows: "f(q)·p²",
    },
    Case {
        signature: "q; p",
        parameters: "l",
        h: "(1 + l*q^2)*p^2/2",
        rows: "f(q)·p²",
    },
    Case {
        signature: "q; p",
        parameters: "",
        h: "(1 - q^2)*p^2",
        rows: "f(q)·p²",
    },
    Case {
        signature: "q; p",
        parameters: "a b",
        h: "(a + b*q)*p^2",
        rows: "f(q)·p²",
    },
    Case {
        signature: "r, th; p, pt",
        parameters: "a",
        h: "(r^2 - 2*r + a^2)*p^2/2 + pt^2/2",
        rows: "f(q)·p²",
    },
    Case {
        signature: "q; p",
        parameters: "",
        h: "sin(q)*p",
        rows: "f(q)·p",
    },
    Case {
        signature: "q; p",
        parameters: "a",
        h: "(a + cos(q))*p",
        rows: "f(q)·p",
    },
    Case {
        signature: "q; p",
        parameters: "",
        h: "(1 + q^2)*p",
        rows: "f(q)·p",
    },
    Case {
        signature: "q; p",
        parameters: "",
        h: "(1 - q^2)*p",
        rows: "f(q)·p",
    },
    Case {
        signature: "q; p",
        parameters: "",
        h: "exp(q)*p",
        rows: "f(q)·p",
    },
    Case {
        signature: "q; p",
        parameters: "",
        h: "cosh(q)*p",
        rows: "f(q)·p",
    },
    Case {
        signature: "x, y; px, py",
        parameters: "b",
        h: "(px - b*y*x^2)^2/2",
        rows: "shear",
    },
    Case {
        signature: "x, y; px, py",
        parameters: "m k",
        h: "(px^2 + py^2)/(2*m) - k/sqrt(x^2 + y^2)",
        rows: "Kepler",
    },
    Case {
        signature: "x, y, z; px, py, pz",
        parameters: "k",
        h: "px^2 + py^2 + pz^2 + 1/(k*hypot(hypot(x, y), z))",
        rows: "Kepler",
    },
    Case {
        signature: "r, th; p, pt",
        parameters: "m",
        h: "p^2/(2*m) + pt^2/(2*m*r^2)",
        rows: "free flight",
    },
    Case {
        signature: "r, th; p, pt",
        parameters: "L",
        h: "p^2/2 + (pt^2 + L^2/sin(th)^2)/(2*r^2)",
        rows: "free flight",
    },
    Case {
        signature: "th, ph; pt, pp",
        parameters: "b",
        h: "b*(pt^2 + pp^2/sin(th)^2)",
        rows: "great circle",
    },
    Case {
        signature: "r, th, ph; p, pt, pp",
        parameters: "",
        h: "p^2/2 + (pt^2 + pp^2/sin(th)^2)/(2*r^2)",
        rows: "free flight",
    },
    Case {
        signature: "x, y, z; px, py, pz",
        parameters: "mu",
        h: "mu*(x*py - y*px)/(x^2 + y^2 + z^2)^(3/2) + (x^2 + y^2)/(x^2 + y^2 + z^2)^3",
        rows: "rotation",
    },
    Case {
        signature: "l, g; L, G",
        parameters: "A",
        h: "(G^2 - L^2)*sin(l)^2/(2*A)",
        rows: "spin component",
    },
    Case {
        signature: "l, g; L, G",
        parameters: "B",
        h: "(G^2 - L^2)*cos(l)^2/(2*B)",
        rows: "spin component",
    },
    Case {
        signature: "a, b; z, w",
        parameters: "J",
        h: "J*sqrt(1 - z^2/9)*cos(a)*sqrt(1 - w^2/9)*cos(b)",
        rows: "spin component",
    },
    Case {
        signature: "q; p",
        parameters: "g",
        h: "g*(q^2 + p^2)^2/4",
        rows: "quadratic form",
    },
    Case {
        signature: "q, r; p, s",
        parameters: "",
        h: "q*r + p*s",
        rows: "quadratic form",
    },
    Case {
        signature: "x, y; px, py",
        parameters: "B",
        h: "(px + B*y/2)^2/2 + (py - B*x/2)^2/2",
        rows: "quadratic form",
    },
    Case {
        signature: "x, y; px, py",
        parameters: "B E",
        h: "px^2/2 + (py - B*x)^2/2 - E*x",
        rows: "quadratic form",
    },
    Case {
        signature: "x, y, z; px, py, pz",
        parameters: "B",
        h: "(px + B*y/2)^2/2 + (py - B*x/2)^2/2 + pz^2/2",
        rows: "quadratic form",
    },
    Case {
        signature: "x, y; px, py",
        parameters: "",
        h: "px^2/2 + py^2/2 - (x*py - y*px)",
        rows: "quadratic form",
    },
    Case {
        signature: "x, y, z; px, py, pz",
        parameters: "B",
        h: "(px^2 + py^2 + pz^2)/2 + B*(x*py - y*px)/2",
        rows: "quadratic form",
    },
    Case {
        signature: "x, y; px, py",
        parameters: "a b",
        h: "(px^2 + a*x^2)/2 + (py^2 + b*y^2)/2",
        rows: "quadratic form",
    },
    Case {
        signature: "x, y; px, py",
        parameters: "B",
        h: "sqrt(1 + (px + B*y/2)^2 + (py - B*x/2)^2)",
        rows: "quadratic form",
    },
    Case {
        signature: "r, th; p, pt",
        parameters: "",
        h: "p^2*pt^2/r^2",
        rows: "monomial",
    },
    // Parameters of the two-term families, and those that may be 0.
    Case {
        signature: "q; p",
        parameters: "a b c k",
        h: "(a + b*cos(k*q) + c*sin(k*q))*p",
        rows: "f(q)·p",
    },
    Case {
        signature: "q; p",
        parameters: "a b c k",
        h: "(a + b*exp(k*q) + c*exp(-k*q))*p",
        rows: "f(q)·p",
    },
    Case {
        signature: "q; p",
        parameters: "k",
        h: "exp(k*q)*p",
        rows: "f(q)·p",
    },
    Case {
        signature: "q; p",
        parameters: "k",
        h: "sin(k*q)*p",
        rows: "f(q)·p",
    },
    Case {
        signature: "q; p",
        parameters: "a b",
        h: "cos(a*q + b*p)",
        rows: "quadratic form",
    },
    Case {
        signature: "q, x; p, y",
        parameters: "a b",
        h: "exp(a*x*q^2 + b*p)",
        rows: "shear",
    },
    Case {
        signature: "f; z",
        parameters: "J",
        h: "J*sqrt(1 - z^2)*cos(f)",
        rows: "spin component",
    },
    Case {
        signature: "r; p",
        parameters: "l",
        h: "p^2 + l/r^2",
        rows: "free flight",
    },
    Case {
        signature: "r, x; p, y",
        parameters: "l",
        h: "p^2 + (y^2 - l*x^2)/r^2",
        rows: "free flight",
    },
    Case {
        signature: "r, th, f; p, pt, pf",
        parameters: "",
        h: "p^2/2 + (pt^2 + pf^2/sin(th)^2)/(2*r^2)",
        rows: "free flight",
    },
    Case {
        signature: "q, u; p, v",
        parameters: "",
        h: "q*p^2*u + v^2*0",
        rows: "monomial",
    },
];

#[test]
fn systems_are_split_unaided() {
    let mut others = Vec::new();
    for found in FOUND {
        let mut model = common::system(found.signature, "", found.parameters, found.h);
        let splitting = match find(&mut model) {
            Ok(splitting) => splitting,
            Err(refusal) => panic!("{}: {refusal:?}", found.h),
        };
        let names: Vec<&str> = splitting.pieces.iter().map(|p| p.name.as_str()).collect();
        println!("{} {:?}", found.h, splitting.choice);
        if names != found.pieces {
            others.push((
                names.iter().map(|n| n.to_string()).collect::<Vec<_>>(),
                found.pieces,
            ));
        }
        let pieces: Vec<_> = splitting.pieces.iter().map(|p| p.h).collect();
        assert!(check_split(&mut model, &pieces).is_ok(), "{}", found.h);
    }
    assert!(others.is_empty(), "{others:#?}");
}

#[test]
fn compositions_of_programs_converge() {
    for found in FOUND {
        // The point of the last is too far out for its A(q) at these steps.
        let Some(slope) = slope(found) else {
            continue;
        };
        assert!((slope - 2.0).abs() < 0.05, "{}: {slope}", found.h);
    }
}

/// The slope of the composition of second order, run by the programs of its pieces: what the last
/// two of three halvings of the step change; `None` for one piece, which is exact.
fn slope(found: &Found) -> Option<f64> {
    let mut model = common::system(found.signature, "", found.parameters, found.h);
    model.pieces = find(&mut model).unwrap().pieces;
    let count = model.pieces.len();
    let wanted: Vec<Purpose> = (0..count).map(|n| Purpose::Piece(n as u16)).collect();
    let program = derive(&mut model, &wanted).unwrap();
    let n = model.groups.len();
    let end = |steps: u32| {
        let mut point = Point::<DoubleDouble>::new();
        point.scalars = model
            .parameters
            .iter()
            .enumerate()
            .map(|(at, _)| DoubleDouble::from(0.4 + 0.3 * at as f64))
            .collect();
        for group in 0..n {
            for (side, value) in [
                (Side::Q, 2.9 - 0.8 * group as f64),
                (Side::P, 0.3 + 0.2 * group as f64),
            ] {
                let target = Target::Phase(Column {
                    side,
                    group: group as u16,
                    column: 0,
                });
                point
                    .outputs
                    .insert(target, vec![vec![DoubleDouble::from(value)]]);
            }
        }
        let h = DoubleDouble::from(0.03125) / DoubleDouble::from(f64::from(steps));
        let half = h * DoubleDouble::from(0.5);
        for _ in 0..steps {
            let down = (0..count - 1).map(|at| (at, half));
            let up = (0..count - 1).rev().map(|at| (at, half));
            for (at, c) in down.chain([(count - 1, h)]).chain(up) {
                point.c = c;
                point.outputs = run(&program, &program.functions[at], &point).outputs;
            }
        }
        let mut targets: Vec<_> = point
            .outputs
            .iter()
            .map(|(target, columns)| (*target, columns[0][0]))
            .collect();
        targets.sort_by_key(|(target, _)| *target);
        targets
            .into_iter()
            .map(|(_, value)| value)
            .collect::<Vec<_>>()
    };
    let ends = [8, 16, 32].map(end);
    (count > 1).then(|| slope_of(ends))
}

/// The order of a composition, by its ends after steps that are halved twice.
fn slope_of([a, b, c]: [Vec<DoubleDouble>; 3]) -> f64 {
    let apart = |a: &[DoubleDouble], b: &[DoubleDouble]| {
        let squares = a.iter().zip(b).map(|(a, b)| (*a - *b).to_f64().powi(2));
        squares.sum::<f64>().sqrt()
    };
    (apart(&a, &b) / apart(&b, &c)).log2()
}

/// Short flows of (34)'s coupled piece, there and back: rounding leaves its energy where it was, to
/// ε√n. What rounds to one side more often, √(1 + sinh²) for the hyperbolic cosine, leaves nε/4.
#[test]
fn short_flows_round_to_both_sides() {
    const PAIRS: usize = 50_000;
    let mut model = common::system("q; p", "", "", "0.5*q^2*(p^2 + 1)");
    model.pieces = find(&mut model).unwrap().pieces;
    let program = derive(&mut model, &[Purpose::Piece(0)]).unwrap();
    let target = |side| {
        Target::Phase(Column {
            side,
            group: 0,
            column: 0,
        })
    };
    let mut point = Point::<f64>::new();
    point.outputs.insert(target(Side::Q), vec![vec![0.7]]);
    point.outputs.insert(target(Side::P), vec![vec![0.3]]);
    let energy = |point: &Point<f64>| {
        let at = |side| point.outputs[&target(side)][0][0];
        let (q, p): (f64, f64) = (at(Side::Q), at(Side::P));
        q * q * (p * p + 1.0)
    };
    let start = energy(&point);
    for n in 0..PAIRS {
        let c = 1e-4 * (0.5 + (n as f64 * 0.618_033_988_749_895).fract());
        for c in [c, -c] {
            point.c = c;
            point.outputs = run(&program, &program.functions[0], &point).outputs;
        }
    }
    let moved = (energy(&point) / start - 1.0).abs();
    let random = f64::EPSILON * (2.0 * PAIRS as f64).sqrt();
    assert!(moved < 10.0 * random, "{moved:e}, at random {random:e}");
}

#[test]
fn what_has_no_flow_is_refused_by_its_term() {
    let mut others = Vec::new();
    for refused in REFUSED {
        let mut model = common::system(refused.signature, "", refused.parameters, refused.h);
        match find(&mut model) {
            Err(Refusal { text, .. }) if text == refused.term => {}
            other => others.push((refused.h, other)),
        }
    }
    assert!(others.is_empty(), "{others:#?}");
}

/// φ‴ = κφ′, {h, L} = 0 and other identities of derivatives hold on each side of a kink or a jump by
/// itself; a flow that crosses it is none of theirs.
#[test]
fn no_row_crosses_a_kink_or_a_jump() {
    const CROSSED: &[(&str, &str)] = &[
        ("q; p", "(abs(q) + 1)*p"),
        ("q; p", "abs(q)*(p + 1)"),
        ("q; p", "max(q, 1)*p"),
        ("q; p", "(q + min(q, 2))*p"),
        ("q; p", "sqrt((q - 1)^2 + 0)*p"),
        ("q; p", "(sqrt(q^2 + 2*q + 1) + 2)*p"),
        ("q; p", "(sign(q) + 2)*p"),
        ("q; p", "sign(q)*p"),
        ("q; p", "abs(sin(q))*p"),
        ("q; p", "(2 + sign(cos(q)))*sin(q)*p"),
        ("q; p", "(atan(q) + atan(1/q) + 3)*p"),
        ("q; p", "exp(-abs(q))*p"),
        ("q; p", "q*(1 + sign(p)*p)"),
        ("x, y; px, py", "(2 + sign(x))*(x*py - y*px)"),
        ("x, y; px, py", "(2 + sign(x + px))*(x*py - y*px) + 0*px"),
        ("x, y; px, py", "sqrt(x^2)/x*(x*py - y*px)"),
        ("f; z", "sqrt(1 - z^2)*cos(f)*sign(sin(f))"),
        ("q, x; p, y", "p*(q + 1) + (2 + sign(q))*y^2"),
        ("q; p", "a*p + abs(q)"),
        ("q; p", "a*p + sign(q - 1)"),
        ("q; p", "p - (if a < 0 { sign(q - 1) } else { q })"),
        ("q; p", "(p - (if a < 0 { 2 + sign(q - 1) } else { q }))^2"),
    ];
    let mut taken = Vec::new();
    for (signature, h) in CROSSED {
        let mut model = common::model(signature, "", "a");
        let node = common::parse(&mut model, h);
        if let Some(flow) = exact_flow(&mut model, node) {
            taken.push((*h, flow.rows().to_vec()));
        }
    }
    assert!(taken.is_empty(), "{taken:#?}");
    // Nothing crosses a place where it rests, and what is constant crosses nothing.
    const KEPT: &[(&str, &str)] = &[
        ("q; p", "abs(q)*p"),
        ("q; p", "q*abs(q)*p"),
        ("q; p", "max(q, 0)*p"),
        ("x, y; px, py", "abs(x*py - y*px) + 1/hypot(x, y)"),
        ("x, y; px, py", "(x*py - y*px)*max(x^2 + y^2, 1)"),
    ];
    for (signature, h) in KEPT {
        let mut model = common::model(signature, "", "");
        let node = common::parse(&mut model, h);
        assert!(exact_flow(&mut model, node).is_some(), "{h}");
    }
}

/// Sharing may cancel a prepared expression to a number, which has no name to be handed on by.
#[test]
fn numbers_are_not_handed_on() {
    for (signature, parameters, h) in [
        ("q; p", "m w k", "p^2/(2*m) + w*q*p + k*q^2/2"),
        ("q; p", "m g", "p^2/(2*m) - g*q*p/2 + q^4"),
        ("x; u", "c d", "u + c*x*u + d*x*u"),
    ] {
        let mut model = common::system(signature, "", parameters, h);
        model.pieces = find(&mut model).unwrap().pieces;
        let mut wanted = vec![Purpose::EnergyAndGradient, Purpose::ParameterGradient];
        wanted.extend((0..model.pieces.len()).map(|n| Purpose::Piece(n as u16)));
        let program = derive(&mut model, &wanted).unwrap();
        for value in &program.prepared {
            assert!(!program.instruction(*value).is_number(), "{h}");
        }
    }
}

/// Whatever is asked, a search ends, and adds no more to the arena than it may (and what one step
/// of it makes at once).
#[test]
fn searches_are_bounded() {
    let mut random = Random(0xB0);
    let (mut largest, mut found) = (0, 0);
    let all = common::cases(300, 3000);
    for _ in 0..all {
        let mut model = grow(&mut random).0.model();
        // Products and quotients of the expressions so far: long, and of the pattern of no row.
        let h = model.hamiltonian.expect("there is an H");
        if random.chance(0.3) {
            let sine = model.dag.call(Op::Sin, &[h]);
            let squares = model.dag.product(&Rational::ONE, &[(sine, 2), (h, 3)]);
            model.hamiltonian = Some(model.dag.div(squares, sine));
        }
        let before = model.dag.len();
        found += usize::from(find(&mut model).is_ok());
        largest = largest.max(model.dag.len() - before);
    }
    println!("{found} of {all} split, at most {largest} nodes");
    assert!(largest <= 4 * NODES, "{largest} nodes");
    assert!(found > 0 && found < all);
}
