//! J. Wisdom and M. Holman's scheme: planets on ellipses that push each other, in coordinates that make
//! of H such a sum.

use crate::common::geometry::Geometry;
use crate::common::is_heavy;
use crate::common::order::{Order, slope};
use hamiltonian::VectorOf;
use hamiltonian::nalgebra::{Const, Dyn, OMatrix};
use hamiltonian::prelude::*;
use hamiltonian::schemes::author::Description;
use hamiltonian::schemes::walk::Visitor;
use hamiltonian::schemes::{KahanLi6, Yoshida4};
use hamiltonian::{DoubleDouble, Dual, Split};

hamiltonian! {
    /// Planets, measured from their star.
    pub struct FromStar { n: usize, m: [n] }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - sum(i in 0..n, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    coordinates heliocentric(q, m);
    split {
        Star = norm_squared(p_heliocentric[0] - sum(i in 1..n) { p_heliocentric[i] })/(2*m[0]);
        Pulls = -sum(i in 1..n, j in 1..i) {
            m[i]*m[j]/norm(q_heliocentric[i] - q_heliocentric[j])
        };
        Ellipses = sum(i in 1..n) {
            norm_squared(p_heliocentric[i])/(2*m[i]) - m[0]*m[i]/norm(q_heliocentric[i])
        };
    }
}

hamiltonian! {
    /// The same, written in the declared coordinates, in another order.
    pub struct Declared { n: usize, m: [n] }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - sum(i in 0..n, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    coordinates heliocentric(q, m);
    split {
        Ellipses = sum(i in 1..n) { norm_squared(p[i])/(2*m[i]) - m[0]*m[i]/norm(q[i] - q[0]) };
        Pulls = -sum(i in 1..n, j in 1..i) { m[i]*m[j]/norm(q[i] - q[j]) };
        Star = norm_squared(p[0])/(2*m[0]);
    }
}

hamiltonian! {
    /// Two planets and their star in the plane, each measured from the centre of mass of those before.
    pub struct OfJacobi { m: [3] }
    let inside(i) = sum(j in 0..i) { m[j] };
    H(q[3][2]; p[3][2]) = sum(i in 0..3) { norm_squared(p[i])/(2*m[i]) }
        - sum(i in 0..3, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    coordinates jacobi(q, m);
    split {
        Pulls = norm_squared(p_jacobi[0])/(2*inside(3))
            + sum(i in 1..3) { m[0]*m[i]*(1/norm(q_jacobi[i]) - 1/norm(q[i] - q[0])) }
            - m[1]*m[2]/norm(q[1] - q[2]);
        Ellipses = sum(i in 1..3) {
            norm_squared(p_jacobi[i])*(1/m[i] + 1/inside(i))/2 - m[0]*m[i]/norm(q_jacobi[i])
        };
    }
}

hamiltonian! {
    /// The planets of [`FromStar`], eight of them.
    pub struct EightFromStar { m: [9] }
    H(q[9][3]; p[9][3]) = sum(i in 0..9) { norm_squared(p[i])/(2*m[i]) }
        - sum(i in 0..9, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    coordinates heliocentric(q, m);
    split {
        Star = norm_squared(p_heliocentric[0] - sum(i in 1..9) { p_heliocentric[i] })/(2*m[0]);
        Pulls = -sum(i in 1..9, j in 1..i) {
            m[i]*m[j]/norm(q_heliocentric[i] - q_heliocentric[j])
        };
        Ellipses = sum(i in 1..9) {
            norm_squared(p_heliocentric[i])/(2*m[i]) - m[0]*m[i]/norm(q_heliocentric[i])
        };
    }
}

hamiltonian! {
    /// A ring of bodies: the index that wraps keeps them from loops.
    pub struct Closed { m: [9] }
    H(q[9][2]; p[9][2]) = sum(i in 0..9) {
        norm_squared(p[i])/(2*m[i]) + norm_squared(q[(i + 1) % 9] - q[i])/2
    };
    coordinates heliocentric(q, m)
}

/// Two planets of masses ε and ε/2 on ellipses round a star of mass 1, at distances 1 and 2.
fn planets(e: f64) -> ([f64; 3], [[f64; 3]; 3], [[f64; 3]; 3]) {
    let m = [1.0, e, 0.5 * e];
    let q = [[0.0; 3], [1.0, 0.0, 0.1], [-0.3, -2.0, 0.0]];
    let v = [[0.0; 3], [0.1, 1.05, 0.0], [0.7, -0.1, 0.05]];
    let p = [0, 1, 2].map(|i| v[i].map(|v| m[i] * v));
    (m, q, p)
}

type Bodies = State<OMatrix<f64, Dyn, Const<3>>>;

fn from_star(e: f64) -> (FromStar, Bodies) {
    let (m, q, p) = planets(e);
    let system = FromStar::new(3, m.to_vec()).expect("three masses");
    let start = system.from_declared(&State::new(q.to_vec(), p.to_vec()));
    (system, start)
}

/// The largest |H − H₀|/|H₀| in each of two halves of a run.
fn halves<S: Split>(system: &S, start: &State<VectorOf<S>>, h: f64, steps: u64) -> [f64; 2] {
    let first = system.energy(start);
    let mut run = Integrator::new(system, Strang, start.clone(), h).expect("a good start");
    [(); 2].map(|()| {
        let states = run.states(1).take(steps as usize / 2);
        let off =
            states.map(|state| (system.energy(&state.expect("a good step")) / first - 1.0).abs());
        off.fold(0.0, f64::max)
    })
}

#[test]
fn errors_are_of_second_order_and_of_the_size_of_the_planets() {
    let mut by_mass = Vec::new();
    for e in [1e-3, 1e-4, 1e-5] {
        let (system, start) = from_star(e);
        let errors: Vec<(f64, f64)> = [0.16, 0.08, 0.04, 0.02]
            .map(|h| (h, halves(&system, &start, h, (8.0 / h) as u64)[0]))
            .to_vec();
        let found = slope(&errors);
        println!("{e:e}: {errors:?}, slope {found}");
        assert!((found - 2.0).abs() < 0.1, "{e:e}: {found}, {errors:?}");
        by_mass.push((e, errors[0].1));
    }
    let found = slope(&by_mass);
    println!("by the masses: {found}");
    assert!((found - 1.0).abs() < 0.05, "{found}, {by_mass:?}");
    // A scheme that knows nothing of ellipses has errors that do not see the masses.
    let verlet = |e: f64| {
        let (system, start) = from_star(e);
        let mut run = Integrator::new(&system, StormerVerlet::default(), start, 0.02)
            .expect("a good start")
            .observe(EnergyDrift::new());
        run.advance(200).expect("good steps");
        run.observer().max_relative()
    };
    assert!((verlet(1e-5) / verlet(1e-3) - 1.0).abs() < 0.1);
}

#[test]
fn many_bodies_of_a_literal_number_have_the_bits_of_a_number_set_at_run_time() {
    let m = [1.0, 1e-6, 2e-6, 3e-6, 1e-6, 9e-4, 3e-4, 4e-5, 5e-5];
    let mut some = crate::common::derivatives::numbers(9);
    let mut rows =
        |size: f64| [(); 9].map(|()| [(); 3].map(|()| size * some.next().unwrap_or(1.0)));
    let (mut q, mut p) = (rows(0.2), rows(0.1));
    for (i, (q, p)) in q.iter_mut().zip(&mut p).enumerate() {
        let r = i as f64;
        q[0] += r;
        *p = p.map(|p| p * m[i]);
        p[1] += if i > 0 { m[i] / r.sqrt() } else { 0.0 };
    }
    let declared = State::new(q, p);
    let literal = EightFromStar::new(m);
    let start = literal.from_declared(&declared);
    let mut run = Integrator::new(&literal, Strang, start, 0.02).expect("a good start");
    let sized = FromStar::new(9, m.to_vec()).expect("nine masses");
    let start = sized.from_declared(&State::new(q.to_vec(), p.to_vec()));
    let mut other = Integrator::new(&sized, Strang, start, 0.02).expect("a good start");
    for _ in 0..3 {
        let end = run.advance(50).expect("good steps");
        let expected = other.advance(50).expect("good steps");
        assert_eq!(end.q.as_slice(), expected.q.as_slice());
        assert_eq!(end.p.as_slice(), expected.p.as_slice());
    }
}

#[test]
fn bodies_that_loops_cannot_say_are_written_out() {
    let q: [[f64; 2]; 9] = core::array::from_fn(|i| [i as f64, 0.5 * (i * i) as f64]);
    let p: [[f64; 2]; 9] = core::array::from_fn(|i| [1.0 - i as f64, 0.25]);
    let system = Closed::new([2.0; 9]);
    let there = system.from_declared(&State::new(q, p));
    let mut expected = 0.0;
    for i in 0..9 {
        let next = q[(i + 1) % 9];
        expected += (p[i][0].powi(2) + p[i][1].powi(2)) / 4.0;
        expected += ((next[0] - q[i][0]).powi(2) + (next[1] - q[i][1]).powi(2)) / 2.0;
    }
    let found = system.energy(&there);
    assert!((found / expected - 1.0).abs() < 1e-14, "{found} {expected}");
}

#[test]
fn energy_does_not_drift() {
    let steps = if is_heavy() { 10_000_000 } else { 100_000 };
    let (system, start) = from_star(1e-3);
    let [early, late] = halves(&system, &start, 0.1, steps);
    println!("{early:e} {late:e}");
    assert!(late < 1.05 * early && early < 1e-5, "{early:e} {late:e}");
}

#[test]
fn orders_and_forms() {
    let (m, q, p) = planets(0.02);
    let flat = |rows: &[[f64; 3]; 3], columns: usize| -> Vec<f64> {
        (0..columns).flat_map(|c| rows.map(|row| row[c])).collect()
    };
    // The numbers are taken as they are for those in the new coordinates: any point will do.
    let exact = OfJacobi {
        m: m.map(DoubleDouble::from).into(),
    };
    let mut order = Order::new(exact, &flat(&q, 2), &flat(&p, 2), 2.0, 0.125);
    order.visit(Strang);
    order.visit(Yoshida4);
    order.visit(KahanLi6);
    println!(
        "{:?}",
        order
            .measured
            .iter()
            .map(|(_, slope)| slope)
            .collect::<Vec<_>>()
    );
    assert_eq!(order.measured.len(), 3);

    let masses = m.map(Dual::fixed).to_vec();
    let system = FromStar::new(3, masses.clone()).expect("three masses");
    let declared = Declared::new(3, masses).expect("three masses");
    let jacobi = OfJacobi {
        m: m.map(Dual::fixed).into(),
    };
    let (q3, p3) = (flat(&q, 3), flat(&p, 3));
    let mut geometry = Geometry::new(system, &q3, &p3, 0.2);
    geometry.visit(Strang);
    geometry.visit(BlanesMoan4);
    let mut other = Geometry::new(declared, &q3, &p3, 0.2);
    other.visit(Strang);
    let mut third = Geometry::new(jacobi, &flat(&q, 2), &flat(&p, 2), 0.2);
    third.visit(Strang);
    let found = [&geometry.measured, &other.measured, &third.measured].map(Vec::len);
    assert_eq!(found, [6, 3, 3]);
}

#[test]
fn pieces_are_the_authors() {
    // Alone a planet is on its ellipse exactly, in steps of any length.
    let system = FromStar::new(2, vec![1.0, 1e-3]).expect("two masses");
    let declared = Declared::new(2, vec![1.0, 1e-3]).expect("two masses");
    let names = [system.description(), declared.description()].map(Description::piece_names);
    assert_eq!(names[0], ["Star", "Pulls", "Ellipses"]);
    assert_eq!(names[1], ["Ellipses", "Pulls", "Star"]);
    let whole = State::new(
        vec![[0.0; 3], [1.0, 0.0, 0.0]],
        vec![[0.0; 3], [0.0, 1.2e-3, 0.0]],
    );
    let alone = system.piece_ellipses();
    let start = system.from_declared(&whole);
    let first = alone.energy(&start);
    let mut run = Integrator::new(&alone, Strang, start.clone(), 3.7).expect("a good start");
    let end = run.advance(50).expect("good steps");
    assert!((alone.energy(end) / first - 1.0).abs() < 1e-12);
    let mut once = Integrator::new(&alone, Strang, start, 185.0).expect("a good start");
    let once = once.advance(1).expect("a good step");
    assert!((&once.q - &end.q).abs().max() < 1e-11, "{once:?} {end:?}");
}
