//! Shapes of flows as they are emitted: loops whose terms do not commute, a term at the last row, and
//! limits where formulas have 0/0.

use super::ANY;
use super::pieces::{Case, check};
use hamiltonian::nalgebra;
use hamiltonian::prelude::*;

hamiltonian! {
    /// Each site is pulled by the next.
    pub struct Chain { n: usize, g = 0.7 }
    H(q[n]; p[n]) = g*sum(i in 1..n) { q[i]*p[i - 1] }
}

hamiltonian! {
    /// The same with kinetic energy, a closing bond and a flow of the last site alone.
    pub struct Closing { n: usize, g = 0.7 }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + g*sum(i in 1..n) { q[i]*p[i - 1] } + g*q[0]*p[n - 1]/2
        + q[n - 1]^2*p[n - 1]/4
}

hamiltonian! {
    /// Speeds that are linear in the coordinates where k = 0.
    pub struct Speeds { k = 0.0, c = 1.0 }
    H(q, x, y; p, u, v) = sin(k*q)*p + exp(k*x)*u + (c + cos(k*y))*v
}

hamiltonian! {
    /// A wave in a plane of phase space, which is a kick where b = 0.
    pub struct Wave { a = 1.0, b = 0.0 }
    H(q; p) = cos(a*q + b*p)
}

hamiltonian! {
    /// Flight past a centre, which is free where l = 0.
    pub struct Radial { l = 0.0 }
    H(r; p) = p^2 + l/r^2 + r^4;
    split { Flight = p^2 + l/r^2; Well = r^4; }
}

hamiltonian! {
    /// Flight in spherical coordinates, along a meridian where pf = 0.
    pub struct Meridian {}
    H(r, th, f; pr, pt, pf) = pr^2/2 + (pt^2 + pf^2/sin(th)^2)/(2*r^2) - 1/r
}

hamiltonian! {
    /// A spin that a field turns, and that turns by itself where J = 0.
    pub struct Turned { J = 0.0, D = 0.6 }
    H(f; z) = J*sqrt(1 - z^2)*cos(f) + D*z^2
}

/// The flow and its equations, with one number near 0 as well as 0.
macro_rules! limits {
    ($($test:ident: $system:ident, $signature:literal, $name:ident in $values:expr, [$($other:ident = $value:expr),*], $ranges:expr;)*) => {$(
        #[test]
        fn $test() {
            for $name in $values {
                let system = $system { $name, ..Default::default() };
                let parameters: &[(&str, &[f64])] = &[$((stringify!($other), &[$value])),*];
                check(&system, &Case { signature: $signature, parameters, ranges: &$ranges });
            }
        }
    )*};
}

const SMALL: [f64; 4] = [0.0, 1e-12, -1e-7, 0.8];

limits! {
    speeds_whose_rate_vanishes: Speeds, "q, x, y; p, u, v", k in SMALL, [k = k, c = 1.0], [(-0.8, 0.8); 6];
    waves_in_one_variable: Wave, "q; p", b in SMALL, [a = 1.0, b = b], [ANY; 2];
}

/// Of p² + l/r², for l of both signs and 0: flights that do not come to r = 0.
#[test]
fn flights_past_a_centre_that_vanishes() {
    for l in [0.0, 1e-12, -1e-7, 0.8, -0.1] {
        let signature = "r; p";
        let parameters: &[(&str, &[f64])] = &[("l", &[l])];
        let ranges = &[(2.0, 3.0), (-0.3, 0.3)];
        check(
            &RadialFlight { l },
            &Case {
                signature,
                parameters,
                ranges,
            },
        );
    }
}

/// Flights whose angular momentum about the axis, or all of it, vanishes, and that do not come to a pole.
#[test]
fn flights_along_a_meridian_and_a_radius() {
    for [pt, pf] in [
        [1.0, 0.0],
        [1.0, 1e-12],
        [-0.7, -1e-7],
        [0.8, 0.5],
        [0.0, 0.0],
        [1e-12, 0.0],
    ] {
        let signature = "r, th, f; pr, pt, pf";
        let ranges = &[
            (2.0, 3.0),
            (1.2, 1.9),
            (-1.0, 1.0),
            (-0.5, 0.5),
            (pt, pt),
            (pf, pf),
        ];
        check(
            &Meridian::default(),
            &Case {
                signature,
                parameters: &[],
                ranges,
            },
        );
    }
}

/// The flow of J·√(1 − z²)·cos f is the identity where J = 0, so it is tested beside a flow that moves:
/// f grows by 2Dzt. A small J shows, so a flow that is not the limit would. z = ±1 is a pole of this chart, where
/// f' is infinite, so no flow is asked for there.
#[test]
fn a_spin_turns_by_itself_without_a_field() {
    let turned = Turned { J: 0.0, D: 0.6 };
    let names = turned.description().piece_names();
    assert_eq!(names.len(), 2, "{names:?}");
    assert!(names.contains(&"J*sqrt(1 - z^2)*cos(f)"));
    for (f, z) in [(0.3, 0.6), (-2.5, -0.9), (1.5, 0.0)] {
        let off = |field: f64| {
            let turned = Turned { J: field, D: 0.6 };
            let start = State::new([f], [z]);
            let mut run = Integrator::new(&turned, Strang, start, 0.1).expect("it can be run");
            run.advance(20).expect("it stays in its domain");
            let end = run.state();
            apart(&[end.q[0], end.p[0]], &[f + 2.4 * z, z])
        };
        assert!(off(0.0) < 4e-15, "{:e}", off(0.0));
        assert!(off(1e-12) < 1e-11, "{:e}", off(1e-12));
        assert!(off(1e-6) > 1e-7, "{:e}", off(1e-6));
    }
}

/// Rows of a flow that meet in one site each: two sites are one bond.
#[test]
fn bonds_of_two_sites() {
    let closing = Closing::new(2).expect("a size");
    let signature = "q[2]; p[2]";
    let parameters: &[(&str, &[f64])] = &[("g", &[0.7])];
    check(
        &closing,
        &Case {
            signature,
            parameters,
            ranges: &[(-0.8, 0.8); 4],
        },
    );
}

/// The largest difference of two points.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
}

type Sites = State<nalgebra::DVector<f64>>;

/// The errors of `Strang` after t = 1 in 20 steps and in 40, and that of the way back.
macro_rules! errors {
    ($system:expr, $start:expr, $exact:expr) => {{
        let (start, exact): (_, Vec<f64>) = ($start, $exact);
        let numbers =
            |state: &Sites| -> Vec<f64> { state.q.iter().chain(state.p.iter()).copied().collect() };
        let end = |steps: u64, from: Sites, sign: f64| {
            let h = sign / steps as f64;
            let mut run = Integrator::new(&$system, Strang, from, h).expect("it can be run");
            run.advance(steps).expect("it stays in its domain");
            run.state().clone()
        };
        let (coarse, fine) = (end(20, start.clone(), 1.0), end(40, start.clone(), 1.0));
        let back = end(40, fine.clone(), -1.0);
        [
            apart(&numbers(&coarse), &exact),
            apart(&numbers(&fine), &exact),
            apart(&numbers(&back), &numbers(&start)),
        ]
    }};
}

/// One loop of terms that do not commute is swept up and down: order 2, and the way back is exact. The
/// orbit is e^{gtS}q and its inverse's transpose on p, with the shift S.
#[test]
fn a_sweep_alone_has_order_two() {
    let chain = Chain::new(5).expect("a size");
    let (q, p) = ([0.3, -0.7, 1.1, 0.9, -0.4], [0.8, 0.5, -0.6, 0.2, 0.7]);
    let mut exact = Vec::new();
    for at in 0..5 {
        let mut weight = 1.0;
        let mut sum = 0.0;
        for k in 0..5 - at {
            sum += weight * q[at + k];
            weight *= 0.7 / (k as f64 + 1.0);
        }
        exact.push(sum);
    }
    for at in 0..5 {
        let mut weight = 1.0;
        let mut sum = 0.0;
        for k in 0..=at {
            sum += weight * p[at - k];
            weight *= -0.7 / (k as f64 + 1.0);
        }
        exact.push(sum);
    }
    let [coarse, fine, back] = errors!(chain, State::new(q.to_vec(), p.to_vec()), exact);
    let slope = (coarse / fine).log2();
    assert!((slope - 2.0).abs() < 0.05, "{slope}: {coarse:e} {fine:e}");
    assert!(back < 1e-14, "{back:e}");
}

/// A sweep, a bond from the last site to the first, and a flow of the last site, against Gauss's method.
#[test]
fn a_sweep_among_other_pieces_has_order_two() {
    for n in 3..=4 {
        let closing = Closing::new(n).expect("a size");
        let names = closing.description().piece_names();
        assert!(names.len() >= 3, "{names:?}");
        let (q, p) = ([0.3, -0.7, 1.1, 0.9], [0.8, 0.5, -0.6, 0.2]);
        let start = State::new(q[..n].to_vec(), p[..n].to_vec());
        let mut run = Integrator::new(&closing, Gauss::<6>::default(), start.clone(), 0.02)
            .expect("it can be run");
        run.advance(50).expect("it can be solved");
        let end: Sites = run.state().clone();
        let exact: Vec<f64> = end.q.iter().chain(end.p.iter()).copied().collect();
        let [coarse, fine, back] = errors!(closing, start, exact);
        let slope = (coarse / fine).log2();
        assert!(
            (slope - 2.0).abs() < 0.1,
            "{n}: {slope}: {coarse:e} {fine:e}"
        );
        assert!(back < 1e-13, "{back:e}");
    }
}
