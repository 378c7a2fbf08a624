//! Conserved quantities, proven where they are declared: that this file compiles is the proof.
//! Here they are also followed along a run.

use hamiltonian::VectorOf;
use hamiltonian::analysis::{Branch, momentum_from_energy};
use hamiltonian::prelude::*;
use hamiltonian::{observers::Monitor, schemes::author::ObservableKind};

hamiltonian! {
    /// Point masses; how many is known at run time.
    pub struct Gravity { n: usize, G = 1.0, m: [n] }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - G*sum(i in 0..n, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    invariant total_momentum = sum(i in 0..n) { p[i] };
    invariant angular_momentum = sum(i in 0..n) { cross(q[i], p[i]) };
    invariant centre_of_energy = H
}

hamiltonian! {
    /// A periodic Toda lattice.
    pub struct Toda<const N: usize> {}
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 + exp(q[i] - q[(i + 1) % N]) };
    invariant total_momentum = sum(i in 0..N) { p[i] }
}

hamiltonian! {
    /// Three of them, with the cubic integral.
    pub struct Toda3 {}
    H(q[3]; p[3]) = sum(i in 0..3) { p[i]^2/2 + exp(q[i] - q[(i + 1) % 3]) };
    invariant total_momentum = sum(i in 0..3) { p[i] };
    invariant cubic = sum(i in 0..3) {
        p[i]^3/3 + (p[i] + p[(i + 1) % 3])*exp(q[i] - q[(i + 1) % 3])
    }
}

hamiltonian! {
    /// A planet in space.
    pub struct Kepler { mu = 1.0 }
    H(q[3]; p[3]) = norm_squared(p)/2 - mu/norm(q);
    invariant angular_momentum = cross(q, p);
    invariant runge_lenz = cross(p, cross(q, p)) - mu*q/norm(q)
}

hamiltonian! {
    /// Hénon–Heiles with the sign that makes it integrable.
    pub struct HenonHeilesPlus {}
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + (x^2 + y^2)/2 + x^2*y + y^3/3;
    invariant second = p_x*p_y + x*y + x^3/3 + x*y^2
}

hamiltonian! {
    /// A geodesic of Kerr, its energy E and angular momentum L as parameters.
    pub struct Kerr { a = 0.9, M = 1.0, E = 0.95, L = 3.0 }
    let Sigma = r^2 + a^2*cos(theta)^2;
    let Delta = r^2 - 2*M*r + a^2;
    H(r, theta; p_r, p_theta) = (Delta*p_r^2 + p_theta^2 - ((r^2 + a^2)*E - a*L)^2/Delta
        + (L - a*E*sin(theta)^2)^2/sin(theta)^2)/(2*Sigma);
    /// Carter's constant, with the rest mass that H gives.
    invariant carter = p_theta^2 + cos(theta)^2*(a^2*(-2*H - E^2) + L^2/sin(theta)^2);
    /// The same for a unit rest mass.
    invariant carter_of_unit_mass = p_theta^2
        + cos(theta)^2*(a^2*(1 - E^2) + L^2/sin(theta)^2) on H = -1/2
}

hamiltonian! {
    /// One whose invariants depend on time, and use H and brackets.
    pub struct FreeFall { g = 9.81 }
    let boost = p*t - q + g*t^2/2;
    H(q; p; t) = p^2/2 + g*q;
    let slope = bracket(q, H);
    invariant start = boost;
    invariant doubled = 2*H - slope^2 - 2*g*q + H
}

/// Follows every invariant along a run with RK4: the largest change, relative to 1 + |value|.
fn drift<S: System>(system: &S, start: State<VectorOf<S>>, step: f64, steps: u64) -> f64 {
    let declared = &system.description().observables;
    assert!(declared.iter().all(|o| o.kind == ObservableKind::Invariant));
    let mut run = Integrator::new(system, RungeKutta4, start, step)
        .unwrap()
        .observe(Monitors::new());
    run.advance(steps).unwrap();
    let all = run.observer().all();
    assert_eq!(all.len(), declared.len());
    let change = |m: &Monitor<f64>| m.drift.max_absolute() / (1.0 + m.drift.start().abs());
    all.iter().map(change).fold(0.0, f64::max)
}

fn tiny(drift: f64) {
    assert!(drift < 1e-10, "{drift:e}");
}

#[test]
fn bodies() {
    for n in [1, 2, 3, 7] {
        let masses: Vec<f64> = (0..n).map(|i| 1.0 + 0.1 * i as f64).collect();
        let gravity = Gravity::new(n, masses).unwrap();
        let mut start = System::zeros::<f64>(&gravity);
        let mut momenta = start.clone();
        for i in 0..n {
            let x = i as f64;
            for (c, value) in [3.0 * x.cos(), 3.0 * x.sin(), x].into_iter().enumerate() {
                start[(i, c)] = value;
            }
            for (c, value) in [0.2 - 0.1 * x, 0.3, 0.1 * x].into_iter().enumerate() {
                momenta[(i, c)] = value;
            }
        }
        let state = State {
            t: 0.0,
            q: start,
            p: momenta,
        };
        let total = gravity.total_momentum(&state);
        assert!((total[1] - 0.3 * n as f64).abs() < 1e-14);
        tiny(drift(&gravity, state, 1e-3, 1000));
    }
}

#[test]
fn toda() {
    let q: [f64; 8] = [0.1, -0.2, 0.3, 0.15, -0.05, 0.2, 0.4, -0.3];
    let p = [0.1, 0.2, 0.3, -0.1, -0.2, 0.05, 0.3, -0.4];
    tiny(drift(&Toda::<8> {}, State::new(q, p), 1e-3, 1000));
    tiny(drift(&Toda::<1> {}, State::new([0.1], [0.2]), 1e-3, 10));
    let start = State::new([0.3, -0.1, -0.2], [0.5, -0.4, -0.1]);
    // Computed in quadruple precision.
    let cubic: f64 = Toda3 {}.cubic(&start);
    assert!((cubic + 0.140_790_725_388_643_4).abs() < 1e-15);
    tiny(drift(&Toda3 {}, start, 1e-3, 5000));
}

#[test]
fn kepler() {
    let start = State::new([0.4, 0.0, 0.1], [0.0, 2.0, 0.3]);
    let kepler = Kepler { mu: 1.1 };
    let l = kepler.angular_momentum(&start);
    let a = kepler.runge_lenz(&start);
    let along: f64 = l.dot(&a);
    assert!(along.abs() < 1e-15);
    tiny(drift(&kepler, start, 1e-4, 10_000));
}

#[test]
fn henon_heiles_with_the_other_sign() {
    let start = State::new([0.1, -0.1], [0.3, 0.2]);
    tiny(drift(&HenonHeilesPlus {}, start, 1e-3, 10_000));
}

#[test]
fn carter() {
    let kerr = Kerr::default();
    let guess = State::new([8.0, 1.4], [0.05, 0.6]);
    // On the shell both hold.
    let on_shell = momentum_from_energy(&kerr, &guess, 0, -0.5, Branch::Nearest).unwrap();
    let (a, b): (f64, f64) = (kerr.carter(&on_shell), kerr.carter_of_unit_mass(&on_shell));
    assert!((a - b).abs() < 1e-14);
    tiny(drift(&kerr, on_shell, 0.05, 2000));
    // Off it only the first does.
    let mut run = Integrator::new(&kerr, RungeKutta4, guess, 0.05)
        .unwrap()
        .observe(Monitors::new());
    run.advance(2000).unwrap();
    let moved = |name| run.observer().get(name).unwrap().max_absolute();
    assert!(moved("carter") < 1e-9, "{:e}", moved("carter"));
    assert!(moved("carter_of_unit_mass") > 1e-6);
}

#[test]
fn depending_on_time() {
    let start = State::new([0.1], [0.3]).at(0.5);
    tiny(drift(&FreeFall::default(), start, 1e-3, 1000));
}
