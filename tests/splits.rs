//! Exact flows that the macro finds: the pieces of types, their runs, and how these end.

#![allow(clippy::needless_borrow)]

use crate::common::systems::Paper34;
use hamiltonian::errors::StepError;
use hamiltonian::prelude::*;
use hamiltonian::schemes::{Composition, ImplicitMidpoint, Strang};
use hamiltonian::{Error, Scheme};

hamiltonian! {
    /// Orbits about a black hole.
    pub struct Schwarzschild { E = 0.995, L = 4.6 }
    H(r, theta; p_r, p_theta) = (1 - 2/r)*p_r^2/2 + p_theta^2/(2*r^2)
        - E^2/(2*(1 - 2/r)) + L^2/(2*r^2*sin(theta)^2)
}

hamiltonian! {
    /// The same in four pieces by hand, of a charge in a field along the axis.
    pub struct InFour { E = 0.995, L = 4.6, beta = 0.0 }
    let potential = -E^2/(2*(1 - 2/r)) + (L - beta*r^2*sin(theta)^2/2)^2/(2*r^2*sin(theta)^2);
    H(r, theta; p_r, p_theta) = (1 - 2/r)*p_r^2/2 + p_theta^2/(2*r^2) + potential;
    split {
        Potential = potential;
        Turning = p_theta^2/(2*r^2);
        Radial = p_r^2/2;
        Falling = -p_r^2/r;
    }
}

hamiltonian! {
    /// A ring of the discrete nonlinear Schrödinger equation.
    pub struct Ring<const N: usize> { g = 1.0 }
    H(q[N]; p[N]) = sum(i in 0..N) { g*(q[i]^2 + p[i]^2)^2/4 }
        - sum(i in 0..N) { q[i]*q[(i + 1) % N] + p[i]*p[(i + 1) % N] };
    invariant particles = sum(i in 0..N) { q[i]^2 + p[i]^2 }
}

hamiltonian! {
    /// Vortices in the plane, x and y scaled with the root of their strength.
    pub struct Vortices { n: usize, k: [n] }
    H(x[n]; y[n]) = -sum(i in 0..n, j in 0..i) {
        k[i]^2*k[j]^2*ln((x[i]/k[i] - x[j]/k[j])^2 + (y[i]/k[i] - y[j]/k[j])^2)/(4*pi)
    };
    invariant impulse = sum(i in 0..n) { k[i]*x[i] };
    invariant angular_impulse = sum(i in 0..n) { x[i]^2 + y[i]^2 }
}

hamiltonian! {
    /// Reaches infinity in a finite time.
    pub struct Explodes {}
    H = q*p^2
}

hamiltonian! {
    /// Momenta grow where the coordinate rests.
    pub struct Saddle {}
    H = sin(q)*p
}

hamiltonian! {
    /// A body without forces, in Andoyer's variables.
    pub struct Body { A = 1.0, B = 2.0, C = 3.0 }
    H(l, g; p_l, p_g) = (p_g^2 - p_l^2)*(sin(l)^2/A + cos(l)^2/B)/2 + p_l^2/(2*C)
}

hamiltonian! {
    /// A charge in a dipole.
    pub struct Dipole {}
    H(x, y, z; p_x, p_y, p_z) = ((p_x + y/hypot(hypot(x, y), z)^3)^2
        + (p_y - x/hypot(hypot(x, y), z)^3)^2 + p_z^2)/2
}

fn drift<S, M, const N: usize>(
    system: &S,
    scheme: M,
    start: State<hamiltonian::nalgebra::SVector<f64, N>>,
    h: f64,
    steps: usize,
) -> f64
where
    S: System<Shape = hamiltonian::nalgebra::SVector<(), N>>,
    M: Scheme<S>,
{
    let first = system.energy(&start);
    let mut run = Integrator::new(system, scheme, start, h).unwrap();
    let mut worst: f64 = 0.0;
    for _ in 0..steps {
        run.advance(1).unwrap();
        worst = worst.max((system.energy(&run.state()) - first).abs());
    }
    worst
}

#[test]
fn the_papers_system_is_split_in_two() {
    assert_eq!(
        Paper34::default().description().piece_names(),
        ["p^2/2 + 0.5", "0.5*q^2*p^2 + q^2/2"]
    );
    let start = State::new([-3.0], [0.0]);
    let exact = drift(&Paper34::default(), Strang, start.clone(), 1e-3, 10_000);
    // H = 5 at the start.
    assert!(exact / 5.0 < 1.0e-6, "{exact:e}");
    let midpoint = drift(
        &Paper34::default(),
        ImplicitMidpoint::default(),
        start.clone(),
        1e-3,
        10_000,
    );
    assert!(exact < midpoint, "{exact:e} {midpoint:e}");
    let fourth = drift(
        &Paper34::default(),
        Composition::yoshida(Strang),
        start,
        1e-3,
        10_000,
    );
    assert!(fourth < exact / 100.0, "{fourth:e}");
}

#[test]
fn orbits_about_a_black_hole_stay() {
    let p_theta = 2.062_449_325_976_816;
    let start = State::new([11.0, std::f64::consts::FRAC_PI_2], [0.0, p_theta]);
    let four = drift(&InFour::default(), Strang, start.clone(), 1.0, 100_000);
    assert!((6e-6..7.4e-6).contains(&four), "{four:e}");
    let found = drift(&Schwarzschild::default(), Strang, start, 1.0, 100_000);
    println!("four by hand {four:e}, as found {found:e}");
    assert!(found < 4e-5, "{found:e}");
    assert_eq!(
        InFour::default().description().piece_names(),
        ["Potential", "Turning", "Radial", "Falling"]
    );
}

#[test]
fn a_ring_keeps_its_norm() {
    let ring = Ring::<5>::default();
    assert_eq!(ring.description().pieces.len(), 2);
    let start = State::new([0.9, -0.4, 0.3, 0.7, -0.2], [0.1, 0.5, -0.6, 0.2, 0.8]);
    let first = ring.particles(&start);
    let energy = ring.energy(&start);
    let mut run = Integrator::new(&ring, Strang, start, 0.01).unwrap();
    for _ in 0..2_000 {
        run.advance(1).unwrap();
        let state = run.state();
        assert!((ring.particles(&state) - first).abs() < 1e-12);
        assert!((ring.energy(&state) - energy).abs() < 1e-3);
    }
}

#[test]
fn vortices_keep_their_impulses() {
    let system = Vortices::new(4, vec![1.0, 2.0_f64.sqrt(), 0.5_f64.sqrt(), 1.0]).unwrap();
    let k = [1.0, 2.0_f64.sqrt(), 0.5_f64.sqrt(), 1.0];
    let x = [1.0, -1.0, 0.0, 0.2].iter().zip(k).map(|(x, k)| x * k);
    let y = [0.0, 0.1, 1.2, -1.1].iter().zip(k).map(|(y, k)| y * k);
    let (x, y): (Vec<f64>, Vec<f64>) = (x.collect(), y.collect());
    let start = State::new(x, y);
    let first = (
        system.impulse(&start),
        system.angular_impulse(&start),
        system.energy(&start),
    );
    let mut run = Integrator::new(&system, Strang, start, 0.01).unwrap();
    run.advance(2_000).unwrap();
    let end = run.state();
    assert!((system.impulse(&end) - first.0).abs() < 1e-12);
    assert!((system.angular_impulse(&end) - first.1).abs() < 1e-12);
    assert!((system.energy(&end) - first.2).abs() < 1e-4);
}

#[test]
fn a_flow_that_leaves_its_domain_is_an_error() {
    let start = State::new([1.0], [-1.0]);
    let mut run = Integrator::new(&Explodes::default(), Strang, start.clone(), 2.0).unwrap();
    match run.advance(1) {
        Err(Error::Step(StepError::NotFinite { piece, step, .. })) => {
            assert_eq!((piece.as_deref(), step), (Some("q*p^2"), 1));
        }
        other => panic!("{other:?}"),
    }
    // As long as the formula holds, it is the orbit: q → q·u², p → p/u with u = 1 + p·t.
    let mut run = Integrator::new(&Explodes::default(), Strang, start, 0.5).unwrap();
    let end = run.advance(1).unwrap();
    assert!((end.q[0] - 0.25).abs() < 1e-15 && (end.p[0] + 2.0).abs() < 1e-15);
}

#[test]
fn momenta_grow_at_a_zero_of_f() {
    let start = State::new([std::f64::consts::PI], [1.0]);
    let mut run = Integrator::new(&Saddle::default(), Strang, start, 1.0).unwrap();
    let end = run.advance(1).unwrap();
    assert!(
        (end.p[0] - std::f64::consts::E).abs() < 1e-14,
        "{}",
        end.p[0]
    );
}

#[test]
fn bodies_and_dipoles_split() {
    let start = State::new([0.7, 0.2], [0.5, 1.3]);
    assert!(drift(&Body::default(), Strang, start, 0.01, 2_000) < 1e-5);
    let start = State::new([1.0, 0.3, 0.2], [0.1, 0.4, 0.2]);
    assert!(drift(&Dipole::default(), Strang, start, 0.005, 2_000) < 1e-3);
    assert_eq!(Dipole::default().description().pieces.len(), 2);
}
