//! Removable singularities of flows: at a parameter or a momentum that is 0, and near it, flows are as
//! accurate as elsewhere, over `f64` and over 32 digits.

use super::{Definition, Subject, Verdict, number, orbit};
use crate::tree::Random;
use hamiltonian_lanes::{DoubleDouble as D, Real};

/// What vanishes: a parameter, or a number of the point (coordinates first, then momenta).
#[derive(Clone, Copy)]
enum Vanishing {
    Parameter(usize),
    Number(usize),
}

use Vanishing::{Number, Parameter};

/// Coordinates and momenta, parameters, H, and the numbers that vanish, one at a time.
const LIMITS: &[(&str, &str, &str, &[Vanishing])] = &[
    ("q; p", "k", "exp(k*q)*p", &[Parameter(0)]),
    ("q; p", "k", "sin(k*q)*p", &[Parameter(0)]),
    ("q; p", "k", "cosh(k*q)*p", &[Parameter(0)]),
    ("q; p", "a b k", "(a + b*cos(k*q))*p", &[Parameter(2)]),
    (
        "q; p",
        "a b c k",
        "(a + b*cos(k*q) + c*sin(k*q))*p",
        &[Parameter(3)],
    ),
    (
        "q; p",
        "a b c k",
        "(a + b*exp(k*q) + c*exp(-k*q))*p",
        &[Parameter(3), Parameter(1)],
    ),
    ("q; p", "a b c", "(a + b*q + c*q^2)*p", &[Parameter(2)]),
    (
        "q; p",
        "a b",
        "cos(a*q + b*p)",
        &[Parameter(1), Parameter(0)],
    ),
    ("q; p", "a b", "exp(a*q^2 + b*p)", &[Parameter(1)]),
    ("q; p", "a b", "(a*q + b*p)^3", &[Parameter(1)]),
    (
        "q; p",
        "m w k",
        "p^2*m/2 + w*q*p + k*q^2/2",
        &[Parameter(0), Parameter(2)],
    ),
    (
        "x, y; px, py",
        "B",
        "(px + B*y/2)^2/2 + (py - B*x/2)^2/2",
        &[Parameter(0)],
    ),
    (
        "x, y; px, py",
        "B E",
        "px^2/2 + (py - B*x)^2/2 - E*x",
        &[Parameter(0)],
    ),
    (
        "x, y; px, py",
        "B",
        "px^2/2 + py^2/2 + B*(x*py - y*px)",
        &[Parameter(0)],
    ),
    ("q; p", "a b", "(a + b*q)*p^2", &[Parameter(1)]),
    ("q; p", "l", "(1 + l*q^2)*p^2/2", &[Parameter(0)]),
    ("q; p", "a", "a*q^2*p^3", &[Parameter(0)]),
    ("f; z", "J", "J*sqrt(4 - z^2)*cos(f)", &[Parameter(0)]),
    (
        "f, g; z, w",
        "J",
        "J*sqrt(4 - z^2)*cos(f)*sqrt(4 - w^2)*cos(g)",
        &[Parameter(0)],
    ),
    ("r; p", "l", "p^2 + l/r^2", &[Parameter(0)]),
    (
        "r, x; p, y",
        "l",
        "p^2 + (y^2 - l*x^2)/r^2",
        &[Parameter(0)],
    ),
    (
        "r, th, f; p, pt, pf",
        "",
        "p^2/2 + (pt^2 + pf^2/sin(th)^2)/(2*r^2)",
        &[Number(5), Number(4)],
    ),
    (
        "th, f; pt, pf",
        "",
        "(pt^2 + pf^2/sin(th)^2)/2",
        &[Number(3)],
    ),
    ("th; pt", "L", "(pt^2 + L^2/sin(th)^2)/2", &[Parameter(0)]),
    (
        "x, y; px, py",
        "a k",
        "a*(px^2 + py^2) - k/sqrt(x^2 + y^2)",
        &[Parameter(1), Parameter(0)],
    ),
    (
        "x, y; px, py",
        "B",
        "sqrt(1 + (px + B*y/2)^2 + (py - B*x/2)^2)",
        &[Parameter(0)],
    ),
];

#[test]
fn limits_are_met_with_all_digits() {
    let sizes = [
        0.0, 1e-40, 1e-25, 1e-16, 1e-12, 1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 1e-2, 0.1,
    ];
    let mut faults = Vec::new();
    for (signature, parameters, h, places) in LIMITS {
        let definition = Definition::of(signature, parameters, h, 0);
        let Some(subject) = Subject::whole(&definition) else {
            faults.push(format!("{h}: no flow"));
            continue;
        };
        let mut random = Random(h.len() as u64);
        let each = |place: &Vanishing| sizes.map(|size| (*place, size));
        for (vanishing, size) in places.iter().flat_map(each) {
            let mut right = 0;
            for trial in 0..4 {
                let mut world = subject.world(&mut random);
                for column in world.parameters.iter_mut().flatten().flatten() {
                    *column = number(&mut random, 0.0);
                }
                // Angles and radii are positive.
                let mut z: Vec<f64> = subject
                    .point(&mut random, 0.0)
                    .iter()
                    .map(|x| x.to_f64())
                    .collect();
                z[0] = 0.5 + 0.8 * random.unit();
                let small = if trial % 2 == 0 { size } else { -size };
                match vanishing {
                    Parameter(at) => world.parameters[at][0][0] = small,
                    Number(at) => z[at] = small,
                }
                let c = number(&mut random, 0.0) / 4.0;
                let exact: Vec<D> = z.iter().map(|x| D::from(*x)).collect();
                match subject.judge(0, &world, &exact, c) {
                    Verdict::Right => right += 1,
                    Verdict::Nothing => continue,
                    other => {
                        faults.push(format!("{h} at {small:e}: {other:?}"));
                        continue;
                    }
                }
                let end = subject.act(0, &world, &exact, D::from(c), false);
                let rounded = subject.act(0, &world, &z, c, false);
                let off = end.iter().zip(&rounded).fold(0.0, |most: f64, (a, b)| {
                    let off = (a.to_f64() - b).abs();
                    if off.is_nan() {
                        f64::INFINITY
                    } else {
                        most.max(off)
                    }
                });
                if off > 4e-15 * (1.0 + orbit::largest(&end)).powi(4) {
                    faults.push(format!(
                        "{h} at {small:e}: off by {off:.1e} over f64 at {z:?} {world:?} {c}"
                    ));
                }
            }
            if right == 0 {
                faults.push(format!("{h} at {size:e}: nothing to compare"));
            }
        }
    }
    assert!(faults.is_empty(), "{}: {faults:#?}", faults.len());
}
