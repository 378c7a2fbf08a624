//! Matrices of parameters against sums by hand, and the bits of loops along their rows.

use crate::common::bits;
use hamiltonian::prelude::*;

hamiltonian! {
    /// Elements beside, around and below those of a row.
    pub struct Net { n: usize, k: usize, w: [n][k] }
    H(q[n]; p[n]) = norm_squared(p)/2 + sum(i in 0..n, j in 0..k) {
        w[i][j]*q[i]*q[j % n] + w[i][(j + 1) % k]^2/w[(i + 2) % n][j]*q[i]^2
    }
}

hamiltonian! {
    /// Extents that are numbers and const generics.
    pub struct Fixed<const N: usize> { w: [N][3], z: [3][N] }
    H(q[N]; p[N]) = norm_squared(p)/2 + w[0][2]*q[0] + sum(i in 0..N, j in 0..3) { w[i][j]*q[i]^2*z[j][i] }
}

fn given(i: usize, j: usize) -> f64 {
    1.5 + ((7 * i + 3 * j) as f64).sin()
}

fn near(found: f64, due: f64) {
    assert!(
        (found - due).abs() <= 1e-11 * due.abs().max(1.0),
        "{found} is not {due}"
    );
}

#[test]
fn energies_and_derivatives_are_those_of_sums_by_hand() {
    for (n, k) in [(2, 3), (3, 2), (5, 40), (40, 5), (37, 41)] {
        let row = |i| (0..k).map(|j| given(i, j)).collect();
        let w: Vec<Vec<f64>> = (0..n).map(row).collect();
        let q: Vec<f64> = (0..n).map(|i| given(i, 9)).collect();
        let (mut h, mut dq, mut dw) = (0.0, vec![0.0; n], vec![vec![0.0; k]; n]);
        for (i, j) in (0..n).flat_map(|i| (0..k).map(move |j| (i, j))) {
            let (next, below) = ((j + 1) % k, (i + 2) % n);
            let (a, b) = (w[i][next], w[below][j]);
            h += w[i][j] * q[i] * q[j % n] + a * a / b * q[i] * q[i];
            dq[i] += w[i][j] * q[j % n] + 2.0 * a * a / b * q[i];
            dq[j % n] += w[i][j] * q[i];
            dw[i][j] += q[i] * q[j % n];
            dw[i][next] += 2.0 * a / b * q[i] * q[i];
            dw[below][j] -= a * a / (b * b) * q[i] * q[i];
        }
        let net = Net::new(n, k, w.clone()).unwrap();
        let state = State::new(q, vec![0.0; n]);
        near(net.energy(&state), h);
        let gradient = net.gradient(&state);
        (0..n).for_each(|i| near(gradient.q[i], dq[i]));
        let by_parameters = net.parameter_gradient(&state);
        for (i, j) in (0..n).flat_map(|i| (0..k).map(move |j| (i, j))) {
            near(by_parameters.w()[(i, j)], dw[i][j]);
        }
        bits::check(&net, n as u64);
    }
    for k in 1..=40 {
        let row = |i| (0..k).map(|j| given(i, j)).collect();
        bits::check(
            &Net::new(3, k, (0..3).map(row).collect::<Vec<Vec<f64>>>()).unwrap(),
            k as u64,
        );
    }
    let (w, z) = ([[1.0, 2.0, 3.0]; 4], [[1.0, 2.0, 3.0, 4.0]; 3]);
    let q = [0.5, 0.25, 2.0, 1.0];
    let mut due = 3.0 * q[0];
    for (i, q) in q.iter().enumerate() {
        (0..3).for_each(|j| due += w[i][j] * q * q * z[j][i]);
    }
    near(Fixed::<4>::new(w, z).energy(&State::new(q, [0.0; 4])), due);
}
