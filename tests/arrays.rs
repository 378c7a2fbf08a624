//! Arrays, sums and loops, end to end: derivatives against duals at every length.

use crate::common::derivatives::{LENGTHS, check, close, numbers};
use hamiltonian::errors::InputError;
use hamiltonian::prelude::*;

hamiltonian! {
    /// Point masses under Newtonian gravity; the number of bodies is set at run time.
    pub struct Gravity { n: usize, G = 1.0, m: [n] }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) }
        - G*sum(i in 0..n, j in 0..i) { m[i]*m[j]/norm(q[i] - q[j]) };
    monitor angular_momentum = sum(i in 0..n) { cross(q[i], p[i]) };
    monitor centre = sum(i in 0..n) { m[i]*q[i] }/sum(i in 0..n) { m[i] }
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

hamiltonian! {
    /// Loops over components around and between loops over rows.
    pub struct Columns<const N: usize> {}
    H(q[N][3]; p[N][3]) = sum(c in 0..3, i in 0..N) { p[i][c]^2/2 }
        + sum(c in 0..3) { (sum(i in 0..N) { q[i][c] })^2 }
        + sum(i in 0..N, c in 0..3, j in 0..i) { (c + 1)*q[i][c]*q[j][c]^2*p[i][0] };
    monitor kinetic = sum(c in 0..3, i in 0..N) { p[i][c]^2/2 }
}

/// [`check`] for every length of a system with a length.
macro_rules! for_lengths {
    ($system:ident) => {
        check(&$system::<1>::default());
        check(&$system::<2>::default());
        check(&$system::<3>::default());
        check(&$system::<7>::default());
        check(&$system::<64>::default());
        check(&$system::<131>::default());
    };
}

#[test]
fn bodies_counted_at_run_time() {
    for n in LENGTHS {
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
    let Error::Input(InputError::Shape {
        name,
        expected,
        found,
        ..
    }) = refused
    else {
        panic!("{refused}");
    };
    assert_eq!((&*name, expected, found), ("m", 3, 1));
}

/// A saved run of other masses is refused by the one that differs.
#[test]
fn a_saved_run_names_the_parameter_that_differs() {
    let bodies = |mass| Gravity::new(2, vec![1.0, mass]).unwrap();
    let start = State::new(vec![[0.0; 3], [1.0; 3]], vec![[0.0; 3]; 2]);
    let run = Integrator::new(&bodies(2.0), Strang, start, 0.1).unwrap();
    assert!(Integrator::resume(&bodies(2.0), Strang, run.checkpoint()).is_ok());
    let error = Integrator::resume(&bodies(2.5), Strang, run.checkpoint()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the saved run has another parameter: saved `m[1] = 2.0`, given `m[1] = 2.5`"
    );
}

#[test]
fn chains_with_ends() {
    for n in LENGTHS {
        check(&Fput::new(n).unwrap());
    }
    for_lengths!(Chain);
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
fn loops_over_components_stand_anywhere() {
    for_lengths!(Columns);
    let columns = Columns::<2>::default();
    let (q, p) = (
        [[0.5, -1.0, 2.0], [1.5, 0.25, -0.5]],
        [[1.0, 2.0, 3.0], [-2.0, 0.5, 1.0]],
    );
    let mut expected = p.iter().flatten().map(|p| p * p / 2.0).sum();
    let state = State::new(q, p);
    close(columns.kinetic(&state), expected);
    for (c, (a, b)) in q[0].iter().zip(q[1]).enumerate() {
        expected += (a + b).powi(2);
        expected += (c as f64 + 1.0) * b * a * a * p[1][0];
    }
    close(columns.energy(&state), expected);
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

#[test]
fn parameters_that_nothing_tells_the_scalar_of_are_f64() {
    let chain = Fput::new(2).unwrap();
    assert_eq!((chain.alpha, chain.beta), (0.25, 0.1));
    let state = State::new(vec![1.0, 0.0], vec![0.0, 0.0]);
    close(
        chain.energy(&state),
        1.0 + 0.25 / 3.0 - 0.25 / 3.0 + 0.2 / 4.0,
    );
    assert!(Fput::LATEX.contains("\\alpha") && Chain::<3>::LATEX.contains("N"));
}
