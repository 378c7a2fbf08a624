//! Arrays, sums and loops, end to end: gradients against duals, and against sums written out.

use hamiltonian::prelude::*;
use hamiltonian::{Dual, Dynamics, Flow, Vector};

hamiltonian! {
    /// A periodic Toda lattice of N particles.
    pub struct Toda<const N: usize> {}
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 + exp(q[i] - q[(i + 1) % N]) };
    monitor total_momentum = sum(i in 0..N) { p[i] }
}

hamiltonian! {
    /// Point masses under Newtonian gravity; the number of bodies is set at run time.
    pub struct Gravity { n: usize, G = 1.0, m: [n] }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - G*sum(i in 0..n, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    monitor angular_momentum = sum(i in 0..n) { cross(q[i], p[i]) };
    monitor centre = sum(i in 0..n) { m[i]*q[i] }/sum(i in 0..n) { m[i] }
}

hamiltonian! {
    /// The Fermi–Pasta–Ulam–Tsingou chain with fixed ends, one spring written apart.
    pub struct Fput { n: usize, alpha = 0.25, beta = 0.1 }
    let V(r) = r^2/2 + alpha*r^3/3 + beta*r^4/4;
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/2 } + V(q[0]) + V(q[n - 1])
        + sum(i in 1..n) { V(q[i] - q[i - 1]) }
}

hamiltonian! {
    /// Wrapped indices that run forwards, backwards and in steps of two, and a finished sum inside
    /// a function.
    pub struct Wraps<const N: usize> { a = 0.5 }
    H(q[N]; p[N]) = sqrt(1 + sum(i in 0..N) { p[i]^2*q[(2*i + 1) % N]^2 })
        + sum(i in 0..N) { q[i]*q[(N - 1 - i) % N]^2 + a*i*q[(i - 2) % N]*q[(i + 3) % N] }
        + dot(q, p)^2 + norm(q) + N*q[0]
}

hamiltonian! {
    /// Coordinates of mixed shape with parameter arrays.
    pub struct Mixed { n: usize, w: [3][3], s: [n], c: [n][n] }
    H(x, q[3], z[n], r[n][2]; p_x, p[3], p_z[n], p_r[n][2]) = p_x^2*x + dot(q, w*p) + x*norm(p)
        + sum(i in 0..n) { s[i]*z[i]^2*p_z[i] + norm_squared(r[i])*x + p_r[i][0]*r[i][1] }
        + dot(z, c*p_z) + sum(i in 0..n, k in 0..2) { (k + 1)*r[i][k]*p_r[i][k]^2 }
        + dot([x, p_x, 2], cross(q, p))
}

hamiltonian! {
    /// Conditions inside loops.
    pub struct Walls<const N: usize> { k = 3.0 }
    H(q[N]; p[N]) = sum(i in 0..N) {
        p[i]^2/2 + if q[i] > 0 && q[i] < 1 { k*q[i]^2 } else { min(q[i], 2) + max(p[i], q[i])*sign(q[i]) }
    }
}

fn close(a: f64, b: f64) {
    assert!((a - b).abs() <= 2e-13 * (1.0 + a.abs()), "{a} is not {b}");
}

/// A repeatable list of numbers in (−1, 1), none of them small.
fn numbers(seed: u32) -> impl Iterator<Item = f64> {
    (1u32..).map(move |k| {
        let x = (f64::from(
            k.wrapping_mul(2_654_435_761)
                .wrapping_add(seed.wrapping_mul(40_503))
                >> 8,
        ) / f64::from(1u32 << 24))
            - 0.5;
        x + 0.25 * x.signum()
    })
}

/// The gradient, the Hessian and the flow against duals.
fn check<S>(system: &S)
where
    S: System<f64> + System<Dual<f64>>,
{
    let mut q = System::<f64>::zeros(system);
    let mut p = q.clone();
    for (at, (a, b)) in (0..q.len()).zip(numbers(1).zip(numbers(2))) {
        *q.component_mut(at) = a;
        *p.component_mut(at) = b;
    }
    let state = State { t: 0.0, q, p };
    let gradient = System::<f64>::gradient(system, &state);
    let n = state.q.len();
    let lifted = |from: &<S as System<f64>>::Vector| {
        let mut to = System::<Dual<f64>>::zeros(system);
        for at in 0..n {
            *to.component_mut(at) = Dual::fixed(from.component(at));
        }
        to
    };
    let prepared = System::<f64>::prepare(system);
    for at in 0..2 * n {
        let mut dual = State {
            t: Dual::fixed(0.0),
            q: lifted(&state.q),
            p: lifted(&state.p),
        };
        let mut direction = (System::<f64>::zeros(system), System::<f64>::zeros(system));
        let expected = if at < n {
            dual.q.component_mut(at).eps = 1.0;
            *direction.0.component_mut(at) = 1.0;
            gradient.q.component(at)
        } else {
            dual.p.component_mut(at - n).eps = 1.0;
            *direction.1.component_mut(at - n) = 1.0;
            gradient.p.component(at - n)
        };
        close(System::<Dual<f64>>::energy(system, &dual).eps, expected);
        let column = System::<Dual<f64>>::gradient(system, &dual);
        let (mut hq, mut hp) = (direction.0.clone(), direction.1.clone());
        prepared.hessian_vector(
            0.0,
            &state.q,
            &state.p,
            &direction.0,
            &direction.1,
            &mut hq,
            &mut hp,
        );
        for k in 0..n {
            close(column.q.component(k).eps, hq.component(k));
            close(column.p.component(k).eps, hp.component(k));
        }
    }
    let (mut to_q, mut to_p) = (state.q.clone(), state.p.clone());
    prepared
        .flow(0.125)
        .flow(0.0, &state.q, &state.p, &mut to_q, &mut to_p);
    for k in 0..n {
        close(
            to_q.component(k),
            state.q.component(k) + 0.125 * gradient.p.component(k),
        );
        close(
            to_p.component(k),
            state.p.component(k) - 0.125 * gradient.q.component(k),
        );
    }
}

#[test]
fn rings_of_every_length() {
    check(&Toda::<1>::default());
    check(&Toda::<2>::default());
    check(&Toda::<3>::default());
    check(&Toda::<7>::default());
    check(&Toda::<64>::default());
    let state = State::new([0.1, 0.5, -0.3], [1.0, 2.0, 3.0]);
    let toda = Toda::<3>::default();
    close(
        toda.energy(&state),
        7.0 + (-0.4f64).exp() + 0.8f64.exp() + (-0.4f64).exp(),
    );
    close(toda.total_momentum(&state), 6.0);
}

#[test]
fn bodies_counted_at_run_time() {
    for n in [1, 2, 3, 7] {
        let masses: Vec<f64> = numbers(3).take(n).map(|x| 1.5 + x).collect();
        check(&Gravity::new(n, masses).unwrap());
    }
    let mut bodies = Gravity::new(2, vec![1.0, 2.0]).unwrap();
    bodies.G = 3.0;
    let state = State::new(
        vec![[0.0, 0.0, 0.0], [1.0, 2.0, 2.0]],
        vec![[0.1, 0.2, 0.3], [0.0, 1.0, 0.0]],
    );
    close(bodies.energy(&state), 0.07 + 0.25 - 2.0);
    let angular = bodies.angular_momentum(&state);
    assert_eq!([angular[0], angular[1], angular[2]], [-2.0, 0.0, 1.0]);
    close(bodies.centre(&state)[1], 4.0 / 3.0);
    let by_parameters = bodies.parameter_gradient(&state);
    close(by_parameters.G, -2.0 / 3.0);
    close(by_parameters.m()[1], -1.0 / 8.0 - 1.0);
    assert_eq!((bodies.n(), bodies.m().len()), (2, 2));
    let refused = Gravity::new(3, vec![1.0]).unwrap_err();
    assert_eq!(
        refused,
        Error::Shape {
            name: "m",
            expected: 3,
            found: 1
        }
    );
}

#[test]
fn chains_with_ends() {
    for n in [1, 2, 3, 7] {
        check(&Fput::<f64>::new(n).unwrap());
    }
}

#[test]
fn indices_that_wrap() {
    check(&Wraps::<1>::default());
    check(&Wraps::<2>::default());
    check(&Wraps::<3>::default());
    check(&Wraps::<7>::default());
    let wraps = Wraps::<3>::default();
    let (q, p) = ([0.3, -0.4, 0.5], [1.0, 2.0, -1.0]);
    let mut inner = 1.0;
    let mut outer = 0.0;
    for i in 0..3usize {
        inner += p[i] * p[i] * q[(2 * i + 1) % 3] * q[(2 * i + 1) % 3];
        outer += q[i] * q[2 - i] * q[2 - i];
        outer += 0.5 * i as f64 * q[(i + 1) % 3] * q[i];
    }
    let dot: f64 = q.iter().zip(p).map(|(q, p)| q * p).sum();
    let norm: f64 = q.iter().map(|q| q * q).sum::<f64>().sqrt();
    let expected = f64::sqrt(inner) + outer + dot * dot + norm + 3.0 * 0.3;
    close(wraps.energy(&State::new(q, p)), expected);
}

#[test]
fn coordinates_of_mixed_shape() {
    for n in [1, 2, 3] {
        let w = [[1.0, 0.2, -0.3], [0.4, -0.5, 0.6], [0.7, 0.8, 0.9]];
        let s: Vec<f64> = numbers(4).take(n).collect();
        let c = hamiltonian::private::nalgebra::DMatrix::from_fn(n, n, |i, j| {
            0.3 + i as f64 - 2.0 * j as f64
        });
        check(&Mixed::new(n, w, s, c).unwrap());
    }
    let vector = MixedVector::new(1.0, [1.0, 2.0, 3.0], vec![1.0], vec![[0.5, 0.25]]);
    assert_eq!(vector.r[(0, 1)], 0.25);
}

#[test]
fn conditions_in_loops() {
    check(&Walls::<7>::default());
    let walls = Walls::<2>::default();
    close(
        walls.energy(&State::new([0.5, -1.0], [1.0, 2.0])),
        0.5 + 0.75 + 2.0 - 1.0 - 2.0,
    );
}
