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
    /// The same, softened at the distance `epsilon`, in two parts.
    pub struct Softened { n: usize, m: [n], epsilon = 0.5 }
    let T = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) };
    let V = -sum(i in 0..n, j in 0..i) { m[i]*m[j]/sqrt(norm_squared(q[i] - q[j]) + epsilon^2) };
    H(q[n][3]; p[n][3]) = T + V;
    monitor radius = sum(i in 0..n) { m[i]*norm(q[i]) }/sum(i in 0..n) { m[i] }
}

hamiltonian! {
    /// Coupled oscillators with a stiffness matrix.
    pub struct Coupled { n: usize, K: [n][n] }
    H(q[n]; p[n]) = norm_squared(p)/2 + dot(q, K*q)/2
}

hamiltonian! {
    /// A chain whose k-th spring is k + 1 times as stiff, fixed at both ends.
    pub struct Chain<const N: usize> {}
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 } + q[0]^2/2 + q[N - 1]^2/2
        + sum(k in 0..N - 1) { (k + 1)*(q[k + 1] - q[k])^2/2 }
}

hamiltonian! {
    /// Springs with a quadratic term between fixed walls.
    pub struct Walled<const N: usize> { alpha = 0.25 }
    let V(r) = r^2/2 + alpha*r^3/3;
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 } + V(q[0]) + V(-q[N - 1])
        + sum(i in 1..N) { V(q[i] - q[i - 1]) }
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
    /// [`Toda`] for seven particles, written out.
    pub struct SevenWritten {}
    H(a, b, c, d, e, f, g; pa, pb, pc, pd, pe, pf, pg) =
        (pa^2 + pb^2 + pc^2 + pd^2 + pe^2 + pf^2 + pg^2)/2 + exp(a - b) + exp(b - c) + exp(c - d)
        + exp(d - e) + exp(e - f) + exp(f - g) + exp(g - a)
}

hamiltonian! {
    /// [`Gravity`] for three bodies, written out.
    pub struct ThreeWritten { G = 1.0, m0 = 1.0, m1 = 1.0, m2 = 1.0 }
    let r(x, y, z) = sqrt(x^2 + y^2 + z^2);
    H(x0, x1, x2, y0, y1, y2, z0, z1, z2; u0, u1, u2, v0, v1, v2, w0, w1, w2) =
        (u0^2 + v0^2 + w0^2)/(2*m0) + (u1^2 + v1^2 + w1^2)/(2*m1) + (u2^2 + v2^2 + w2^2)/(2*m2)
        - G*(m1*m0/r(x1 - x0, y1 - y0, z1 - z0) + m2*m0/r(x2 - x0, y2 - y0, z2 - z0)
            + m2*m1/r(x2 - x1, y2 - y1, z2 - z1))
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

/// A repeatable list of numbers in (−¾, ¾), none of them small (SplitMix64).
fn numbers(seed: u64) -> impl Iterator<Item = f64> {
    (1u64..).map(move |k| {
        let z = (k + (seed << 32)).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        let x = ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64 - 0.5;
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
    // Second derivatives in 64 or so directions, whatever the size.
    let stride = (2 * n).div_ceil(64);
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
        if at % stride != 0 {
            continue;
        }
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

/// [`check`] for every length of a system with a length.
macro_rules! for_lengths {
    ($system:ident) => {
        check(&$system::<1>::default());
        check(&$system::<2>::default());
        check(&$system::<3>::default());
        check(&$system::<7>::default());
        check(&$system::<64>::default());
        check(&$system::<200>::default());
    };
}

const LENGTHS: [usize; 6] = [1, 2, 3, 7, 64, 200];

#[test]
fn rings_of_every_length() {
    for_lengths!(Toda);
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
    for n in LENGTHS {
        let masses: Vec<f64> = numbers(3).take(n).map(|x| 1.5 + x).collect();
        check(&Gravity::new(n, masses.clone()).unwrap());
        check(&Softened::new(n, masses).unwrap());
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
    for n in LENGTHS {
        check(&Fput::<f64>::new(n).unwrap());
    }
    for_lengths!(Chain);
    for_lengths!(Walled);
}

#[test]
fn indices_that_wrap() {
    for_lengths!(Wraps);
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
    for n in LENGTHS {
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
    for_lengths!(Walls);
    let walls = Walls::<2>::default();
    close(
        walls.energy(&State::new([0.5, -1.0], [1.0, 2.0])),
        0.5 + 0.75 + 2.0 - 1.0 - 2.0,
    );
}

#[test]
fn matrices_times_vectors() {
    for n in LENGTHS {
        let stiffness = hamiltonian::private::nalgebra::DMatrix::from_fn(n, n, |i, j| {
            1.0 / (1.0 + i as f64 + 2.0 * j as f64)
        });
        check(&Coupled::new(n, stiffness).unwrap());
    }
}

/// Two definitions of one system agree: H, its gradient and its Hessian times a vector.
fn agree<A: System<f64>, B: System<f64>>(a: &A, b: &B) {
    let values = |seed| -> Vec<f64> { numbers(seed).take(a.zeros().len()).collect() };
    let [q, p, vq, vp] = [1, 2, 3, 4].map(values);
    let (here, there) = (all(a, &q, &p, &vq, &vp), all(b, &q, &p, &vq, &vp));
    assert_eq!(here.len(), there.len());
    for (here, there) in here.into_iter().zip(there) {
        close(here, there);
    }
}

fn all<S: System<f64>>(system: &S, q: &[f64], p: &[f64], vq: &[f64], vp: &[f64]) -> Vec<f64> {
    let [q, p, vq, vp] = [q, p, vq, vp].map(|values| {
        let mut vector = system.zeros();
        assert_eq!(vector.len(), values.len());
        for (at, value) in values.iter().enumerate() {
            *vector.component_mut(at) = *value;
        }
        vector
    });
    let prepared = system.prepare();
    let [mut dq, mut dp, mut hq, mut hp] = [(); 4].map(|()| system.zeros());
    let energy = prepared.energy_and_gradient(0.0, &q, &p, &mut dq, &mut dp);
    prepared.hessian_vector(0.0, &q, &p, &vq, &vp, &mut hq, &mut hp);
    let vectors = [dq, dp, hq, hp];
    let components = vectors.iter().flat_map(Vector::components);
    std::iter::once(energy).chain(components).collect()
}

#[test]
fn loops_are_what_they_are_written_out() {
    agree(&Toda::<7>::default(), &SevenWritten::default());
    let mut bodies = Gravity::new(3, vec![1.5, 0.5, 2.0]).unwrap();
    bodies.G = 3.0;
    let written = ThreeWritten {
        G: 3.0,
        m0: 1.5,
        m1: 0.5,
        m2: 2.0,
    };
    agree(&bodies, &written);
}
