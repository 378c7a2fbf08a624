//! Friction on arrays in another time, for any number of elements.

use crate::common::canonical::close;
use hamiltonian::Vector;
use hamiltonian::prelude::*;

/// A force moves p as it says times g, and keeps the state on the shell: what
/// it does to p_t is against what it does to H.
macro_rules! pulled_in_another_time {
    ($system:expr, $start:expr, $gain:expr, $factor:expr) => {{
        let (system, gain, factor) = ($system, $gain, $factor);
        let start = system.on_shell(&$start);
        let force = system.force(&start);
        let (n, mut power) = (start.q.len(), 0.0);
        let gradient = system.gradient(&start);
        for k in 0..n - 1 {
            let expected: f64 = factor * gain * start.p.component(k);
            close(expected, force.component(k));
            // On the shell ∂K/∂p is g·∂H/∂p.
            power += force.component(k) * gradient.p.component(k) / factor;
        }
        close(-power, force.component(n - 1));
        assert!(power.abs() > 1e-3);
    }};
}

hamiltonian! {
    /// A chain with friction; the number of its parts is set at run time.
    pub struct Dragging { n: usize, g = 0.1, m: [n] }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/(2*m[i]) + (q[i] - q[(i + 1) % n])^4 }
        + sum(i in 0..n, j in 0..i) { p[i]*p[j]/9 };
    force(q; p) = -g*p;
    dt = (2 + q[0]^2)*ds
}

hamiltonian! {
    /// A chain whose neighbours share momenta, with friction: the ends have no neighbour to read.
    pub struct Coupled { n: usize, g = 0.1 }
    H(q[n]; p[n]) = norm_squared(p)/2 + sum(i in 0..n - 1) { p[i]*p[i + 1]*q[i]*q[i + 1] };
    force(q; p) = -g*p;
    dt = (1 + norm_squared(q))*ds
}

hamiltonian! {
    /// Momenta that reach further than the shortest chain is long.
    pub struct Far<const N: usize> { g = 0.1 }
    H(q[N]; p[N]) = norm_squared(p)/2 + sum(i in 2..N) { p[i]*p[i - 2]*q[i] };
    force(q; p) = -g*p;
    dt = (1 + norm_squared(q))*ds
}

hamiltonian! {
    /// Bodies with friction, any number of them.
    pub struct Swarm<const N: usize> { g = 0.1 }
    H(q[N][3]; p[N][3]) = sum(i in 0..N) { norm_squared(p[i])*(1 + i)/2 }
        - sum(i in 0..N, j in 0..i) { 1/norm(q[i] - q[j]) };
    force(q; p) = -g*p;
    dt = (3 + norm_squared(q[0]))*ds
}

hamiltonian! {
    /// A literal number, with sums that stay loops.
    pub struct Three { g = 0.1 }
    H(q[3]; p[3]) = sum(i in 0..3) { p[i]^2*(1 + i)/2 } + q[0]^4;
    force(q; p) = -g*p;
    dt = (3 + q[1]^2)*ds
}

#[test]
fn forces_on_arrays_of_any_length() {
    for n in [1usize, 2, 3, 7] {
        let values = |k: f64| {
            (0..n)
                .map(move |i| ((i as f64) * k + 0.4).sin())
                .collect::<Vec<f64>>()
        };
        let system = Dragging::new(n, vec![1.5; n]).unwrap();
        let state = State {
            t: 0.0,
            q: DraggingVector::new(values(1.1), 0.2),
            p: DraggingVector::new(values(0.7), 0.0),
        };
        let factor = 2.0 + state.q.q[0].powi(2);
        pulled_in_another_time!(system, state, -0.1, factor);
        let state = State {
            t: 0.0,
            q: CoupledVector::new(values(1.1), 0.2),
            p: CoupledVector::new(values(0.7), 0.0),
        };
        let factor = 1.0 + values(1.1).iter().map(|q| q * q).sum::<f64>();
        pulled_in_another_time!(Coupled::new(n).unwrap(), state, -0.1, factor);
    }
    fn far<const N: usize>() {
        let values = |k: f64| -> [f64; N] { std::array::from_fn(|i| (i as f64 * k + 0.4).sin()) };
        let state = State {
            t: 0.0,
            q: FarVector::<N, f64>::new(values(1.1), 0.2),
            p: FarVector::<N, f64>::new(values(0.7), 0.0),
        };
        let factor = 1.0 + values(1.1).iter().map(|q| q * q).sum::<f64>();
        pulled_in_another_time!(Far::<N>::default(), state, -0.1, factor);
    }
    far::<1>();
    far::<2>();
    far::<3>();
    far::<7>();
    fn swarm<const N: usize>() {
        let rows = |k: f64| -> [[f64; 3]; N] {
            std::array::from_fn(|i| std::array::from_fn(|c| ((3 * i + c) as f64 * k + 0.4).sin()))
        };
        let state = State {
            t: 0.0,
            q: SwarmVector::<N, f64>::new(rows(1.1), 0.2),
            p: SwarmVector::<N, f64>::new(rows(0.7), 0.0),
        };
        let factor = 3.0 + rows(1.1)[0].iter().map(|x| x * x).sum::<f64>();
        pulled_in_another_time!(Swarm::<N>::default(), state, -0.1, factor);
    }
    swarm::<1>();
    swarm::<2>();
    swarm::<3>();
    swarm::<7>();
    let state = State {
        t: 0.0,
        q: ThreeVector::new([0.3, 0.2, -0.1], 0.2),
        p: ThreeVector::new([0.5, 0.7, -0.4], 0.0),
    };
    pulled_in_another_time!(Three::default(), state, -0.1, 3.0 + 0.04);
}
