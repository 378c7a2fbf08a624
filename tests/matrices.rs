//! Arrays of parameters against sums by hand, and the bits of loops along their rows.

use crate::common::{bits, derivatives};
use hamiltonian::Lattice;
use hamiltonian::errors::InputError;
use hamiltonian::prelude::*;
use std::f64::consts::PI;

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

hamiltonian! {
    /// Neighbours of each axis, shifts, and elements that go round, of arrays with sizes set at run time.
    pub struct Crystal {
        n: usize, m: usize, k: usize,
        w: [n][m][k], v: [n][m][3], z: [2][n][m],
        f: [2][1][3] = [[[1, 1/2, 2]], [[pi/4, -1, 3]]],
    }
    H(u[n][m][k]; p[n][m][k]) = sum(i in 0..n, j in 0..m, l in 0..k) {
            p[i][j][l]^2/2 + z[1][i][j]*f[0][0][2]*u[i][j][l]^2/w[i][j][l]
            + w[(i + 1) % n][j][l]*u[i][j][l]*u[(i + 1) % n][j][l]
            + w[i][(j - 1) % m][l]^2*cos(u[i][j][l]) + w[i][j][(l + 2) % k]*u[i][j][l]
        }
        + sum(i in 0..n, j in 1..m, l in 1..k) { w[i][j - 1][l]*w[i][j][l - 1]*u[i][j][l]*u[i][j - 1][l - 1] }
        + sum(i in 0..n, j in 0..m) { norm_squared(v[i][j])*z[0][i][j]*u[i][j][0] + dot(v[i][j], f[1][0])*u[i][j][0]^2 }
}

hamiltonian! {
    /// The same array with extents that are numbers and const generics, on the stack.
    pub struct Layers<const N: usize> { c: [N][2][3], a: [2][2][2][1] = [[[[1], [2]], [[3], [4]]], [[[5], [6]], [[7], [8]]]] }
    H(q[N], r[2]; p[N], p_r[2]) = norm_squared(p)/2 + norm_squared(p_r)/2 + dot(r, c[0]*[1, 2, 3])
        + sum(i in 0..N, j in 0..2, l in 0..3) { (l + 1)*c[i][j][l]*q[i]^2 }
        + sum(i in 0..2, j in 0..2, l in 0..2) { a[i][j][l][0]*r[i]^2*r[j]*r[l] }
}

hamiltonian! {
    /// Four axes, one of them a const generic.
    pub struct Tesseract<const N: usize> { n: usize, w: [n][N][n][2] }
    H(q[n]; p[n]) = norm_squared(p)/2 + sum(i in 0..n, j in 0..N, k in 0..n, l in 0..2) {
        w[(i + 1) % n][j][k][l]*q[i]*q[k]^(l + 1)
    }
}

fn lattice<const R: usize>(extents: [usize; R], salt: usize) -> Lattice<f64, R> {
    let number = |place: [usize; R]| {
        place
            .iter()
            .enumerate()
            .map(|(axis, at)| (axis + 2) * at)
            .sum::<usize>()
    };
    Lattice::from_fn(extents, |place| given(number(place), salt))
}

fn crystal(n: usize, m: usize, k: usize) -> Crystal {
    let (w, v, z) = (
        lattice([n, m, k], 0),
        lattice([n, m, 3], 1),
        lattice([2, n, m], 2),
    );
    Crystal::new(n, m, k, w, v, z).unwrap()
}

#[test]
fn three_axes_have_the_energies_and_derivatives_of_sums_by_hand() {
    let f = [[[1.0, 0.5, 2.0]], [[PI / 4.0, -1.0, 3.0]]];
    for [n, m, k] in [[1, 1, 1], [2, 3, 4], [3, 2, 37], [1, 5, 40]] {
        let system = crystal(n, m, k);
        let (w, v, z) = (system.w(), system.v(), system.z());
        let u = lattice([n, m, k], 3);
        let (mut h, mut dw) = (0.0, Lattice::zeros([n, m, k]));
        let (mut dz, mut dv) = (Lattice::zeros([2, n, m]), Lattice::zeros([n, m, 3]));
        let mut df = [[[0.0; 3]]; 2];
        for (i, j) in (0..n).flat_map(|i| (0..m).map(move |j| (i, j))) {
            for l in 0..k {
                let (own, [c, e]) = (u[[i, j, l]], [f[0][0][2], z[[1, i, j]]]);
                let a = w[[i, j, l]];
                h += e * c * own * own / a;
                dw[[i, j, l]] -= e * c * own * own / (a * a);
                dz[[1, i, j]] += c * own * own / a;
                df[0][0][2] += e * own * own / a;
                let beside = [(i + 1) % n, j, l];
                h += w[beside] * own * u[beside];
                dw[beside] += own * u[beside];
                let before = [i, (j + m - 1) % m, l];
                h += w[before] * w[before] * own.cos();
                dw[before] += 2.0 * w[before] * own.cos();
                let round = [i, j, (l + 2) % k];
                h += w[round] * own;
                dw[round] += own;
                if j > 0 && l > 0 {
                    let (a, b, far) = ([i, j - 1, l], [i, j, l - 1], u[[i, j - 1, l - 1]]);
                    h += w[a] * w[b] * own * far;
                    dw[a] += w[b] * own * far;
                    dw[b] += w[a] * own * far;
                }
            }
            let first = u[[i, j, 0]];
            for c in 0..3 {
                let (a, b) = (v[[i, j, c]], z[[0, i, j]]);
                h += a * a * b * first + a * f[1][0][c] * first * first;
                dv[[i, j, c]] += 2.0 * a * b * first + f[1][0][c] * first * first;
                dz[[0, i, j]] += a * a * first;
                df[1][0][c] += a * first * first;
            }
        }
        let state = State::new(u, Lattice::zeros([n, m, k]));
        near(system.energy(&state), h);
        let by = system.parameter_gradient(&state);
        for (found, due) in [(by.w(), &dw), (by.v(), &dv), (by.z(), &dz)] {
            assert_eq!(found.extents(), due.extents());
            let both = found.as_slice().iter().zip(due.as_slice());
            both.for_each(|(found, due)| near(*found, *due));
        }
        let both =
            by.f.as_flattened()
                .as_flattened()
                .iter()
                .zip(df.as_flattened().as_flattened());
        both.for_each(|(found, due)| near(*found, *due));
        derivatives::check(&system);
        bits::check(&system, (n + m + k) as u64);
    }
    for k in 1..=40 {
        bits::check(&crystal(2, 2, k), k as u64);
    }
    let tesseract = Tesseract::<3>::new(5, lattice([5, 3, 5, 2], 0)).unwrap();
    derivatives::check(&tesseract);
    derivatives::check(&layers());
}

fn layers() -> Layers<4> {
    Layers::new([[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]; 4])
}

#[test]
fn extents_in_the_type_are_lists_of_lists() {
    let layers = layers();
    assert_eq!(
        layers.a,
        [
            [[[1.0], [2.0]], [[3.0], [4.0]]],
            [[[5.0], [6.0]], [[7.0], [8.0]]]
        ]
    );
    let (q, r) = ([1.0, 2.0, 3.0, 4.0], [1.0, -2.0]);
    // Σ (l + 1) c is 14 + 32, c[0] times (1, 2, 3) is (14, 32).
    let mut due = 46.0 * 30.0 + 14.0 - 64.0;
    for [i, j, l] in [0, 1]
        .map(|i| [0, 1].map(|j| [0, 1].map(|l| [i, j, l])))
        .concat()
        .concat()
    {
        due += layers.a[i][j][l][0] * r[i] * r[i] * r[j] * r[l];
    }
    let zero = LayersVector::new([0.0; 4], [0.0; 2]);
    let state = State::new(LayersVector::new(q, r), zero);
    near(layers.energy(&state), due);
    let other = Layers {
        a: [[[[0.0]; 2]; 2]; 2],
        ..layers
    };
    near(other.energy(&state), 46.0 * 30.0 + 14.0 - 64.0);
}

#[test]
fn lists_of_other_shapes_are_refused_by_the_element_as_declared() {
    let refused = |n, m, k, w: Vec<Vec<Vec<f64>>>| {
        let system = Crystal::new(
            n,
            m,
            k,
            w,
            vec![vec![[1.0; 3]; m]; n],
            vec![vec![vec![1.0; m]; n]; 2],
        );
        system.map(|_| ()).map_err(|error| error.to_string())
    };
    let whole = vec![vec![vec![1.0; 4]; 3]; 2];
    assert_eq!(refused(2, 3, 4, whole.clone()), Ok(()));
    let due = |text: &str| Err(text.to_owned());
    assert_eq!(
        refused(2, 4, 3, whole.clone()),
        due("axis 1 of `w` must have the extent 4, found 3")
    );
    assert_eq!(
        refused(3, 3, 4, whole.clone()),
        due("axis 0 of `w` must have the extent 3, found 2")
    );
    let mut uneven = whole.clone();
    uneven[1][2].pop();
    assert_eq!(
        refused(2, 3, 4, uneven),
        due("`w[1][2]` must have 4 elements, found 3")
    );
    let mut uneven = whole.clone();
    uneven[1].pop();
    assert_eq!(
        refused(2, 3, 4, uneven),
        due("`w[1]` must have 3 elements, found 2")
    );
    let mut nan = whole;
    nan[1][0][3] = f64::NAN;
    assert_eq!(
        refused(2, 3, 4, nan),
        due("the parameter `w[1][0][3]` is NaN, and must be a number")
    );
    assert_eq!(refused(0, 3, 4, Vec::new()), Ok(()));
    let one = [[[1.0]]];
    let is_large = |error: &Error, of: &str| matches!(error, Error::Input(InputError::Memory { name, .. }) if **name == *of);
    let large = Crystal::new(usize::MAX, 2, 2, one, one, one).unwrap_err();
    assert!(is_large(&large, "u"), "{large}");
    let large = Tesseract::<{ 1 << 40 }>::new(1 << 20, lattice([1, 3, 1, 2], 0)).unwrap_err();
    assert!(is_large(&large, "w"), "{large}");
}

#[test]
fn arrays_and_lists_and_lattices_are_given() {
    let (v, z) = ([[[1.0; 3]; 2]; 1], [[[1.0; 2]; 1]; 2]);
    let lists = Crystal::new(1, 2, 3, vec![vec![vec![1.0, 2.0, 3.0]; 2]], v, z).unwrap();
    let mixed = Crystal::new(
        1,
        2,
        3,
        vec![[[1.0, 2.0, 3.0]; 2]],
        vec![vec![[1.0; 3]; 2]],
        z,
    )
    .unwrap();
    let lattice = Crystal::new(1, 2, 3, lists.w().clone(), lists.v().clone(), z).unwrap();
    for other in [mixed, lattice] {
        assert_eq!(
            (lists.w(), lists.v(), lists.z()),
            (other.w(), other.v(), other.z())
        );
    }
    let other = Crystal {
        f: [[[0.0; 3]]; 2],
        ..lists
    };
    assert_eq!(other.f, [[[0.0; 3]]; 2]);
}

#[test]
fn a_saved_run_knows_each_element() {
    let scheme = StormerVerlet::default;
    let start = || State::new(lattice([2, 3, 4], 1), Lattice::zeros([2, 3, 4]));
    let run = Integrator::new(&crystal(2, 3, 4), scheme(), start(), 0.1).unwrap();
    assert!(Integrator::resume(&crystal(2, 3, 4), scheme(), run.checkpoint()).is_ok());
    let mut w = crystal(2, 3, 4).w().clone();
    w[[1, 2, 3]] += 1.0;
    let other = Crystal::new(2, 3, 4, w, lattice([2, 3, 3], 1), lattice([2, 2, 3], 2)).unwrap();
    assert!(Integrator::resume(&other, scheme(), run.checkpoint()).is_err());
    let mut described = String::new();
    System::describe_parameters(&layers(), &mut described).unwrap();
    assert!(described.contains("c[3][1][2] = 6.0\n"), "{described}");
    assert!(described.contains("a[1][0][1][0] = 6.0\n"), "{described}");
}
