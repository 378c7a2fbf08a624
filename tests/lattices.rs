//! Coordinates with several axes, whose loops stay loops.

use crate::common::{bits, derivatives};
use hamiltonian::VectorOf;
use hamiltonian::errors::InputError;
use hamiltonian::prelude::*;
use hamiltonian::{Lattice, Scheme, Vector, observers::Recorder};

hamiltonian! {
    /// Periodic in both directions, of any size.
    pub struct Pendulums { n: usize, m: usize, c = 0.75 }
    H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) {
        p[i][j]^2/2 + c*(1 - cos(u[i][j]))
            + (u[(i + 1) % n][j] - u[i][j])^2/2 + (u[i][(j + 1) % m] - u[i][j])^4/4
    };
    monitor momentum = sum(i in 0..n, j in 0..m) { p[i][j] }
}

hamiltonian! {
    /// A const generic and a number that is too large to be written out.
    pub struct Wide<const N: usize> { c = 0.75 }
    H(u[N][40]; p[N][40]) = sum(i in 0..N, j in 0..40) {
        p[i][j]^2/2 + c*(1 - cos(u[i][j]))
            + (u[(i + 1) % N][j] - u[i][j])^2/2 + (u[i][(j + 1) % 40] - u[i][j])^4/4
    }
}

hamiltonian! {
    /// Open ends, a weight for each site, neighbours two rows away, elements by number and across the
    /// diagonal, a scalar beside the lattice.
    pub struct Mixed { n: usize, m: usize, w: [n][m] }
    H(x, u[n][m]; y, p[n][m]) = y^2/2 + x^2/2 + u[0][1]*u[1][0]
        + sum(i in 0..n, j in 0..m) { p[i][j]^2/(2*w[i][j]) + x*u[i][j]^2 }
        + sum(i in 2..n, j in 1..m) { (u[i][j] - u[i - 2][j])^2 + cos(u[i][j] - u[i][j - 1]) }
        + sum(i in 0..n) { u[i][i % m]^2*norm_squared(u[i]) }
}

hamiltonian! {
    /// Not separable: a neighbour of both axes at once.
    pub struct Coupled { n: usize, m: usize }
    H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) {
        (u[i][j]^2 + 1)*(p[i][j]^2 + 1)/2 + u[(i + 1) % n][(j - 2) % m]*p[i][j]/4
    }
}

hamiltonian! {
    /// Friction.
    pub struct Damped { n: usize, m: usize, gamma = 0.25 }
    H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) { (p[i][j]^2 + u[i][j]^2)/2 };
    force(u; p) = -gamma*p
}

hamiltonian! {
    /// Three axes: periodic in each, a bond across all of them, open ends, a field of three components.
    pub struct Solid { n: usize, m: usize, k: usize, c = 0.75 }
    H(u[n][m][k], v[n][m][3]; p[n][m][k], w[n][m][3]) = sum(i in 0..n, j in 0..m, l in 0..k) {
        p[i][j][l]^2/2 + c*(1 - cos(u[i][j][l])) + (u[(i + 1) % n][j][l] - u[i][j][l])^2/2
            + (u[i][(j + 1) % m][l] - u[i][j][l])^4/4 + exp(u[i][j][(l + 1) % k] - u[i][j][l])
            + u[(i + 1) % n][(j - 1) % m][(l + 1) % k]*u[i][j][l]/4 + v[i][j][0]*u[i][j][l]
    } + sum(i in 0..n, j in 1..m) { norm_squared(w[i][j])/2 + dot(v[i][j], v[i][j - 1])
        + norm_squared(v[i][j]) }
}

hamiltonian! {
    /// Four axes.
    pub struct Tesseract { n: usize }
    H(u[n][n][n][2]; p[n][n][n][2]) = sum(i in 0..n, j in 0..n, k in 0..n, l in 0..2) {
        p[i][j][k][l]^2/2 + (u[(i + 1) % n][j][(k - 1) % n][l] - u[i][j][k][1 - l])^2/2
    }
}

hamiltonian! {
    /// Bonds alone, in three directions: momentum is conserved.
    pub struct Bonds { n: usize, m: usize }
    H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) {
        p[i][j]^2/2 + exp(u[i][j] - u[(i + 1) % n][j]) + (u[i][(j + 1) % m] - u[i][j])^4/4
            + (u[(i + 1) % n][(j - 2) % m] - u[i][j])^2/2
    };
    invariant momentum = sum(i in 0..n, j in 0..m) { p[i][j] }
}

/// A number of modest size for a place.
fn given(i: usize, j: usize, salt: usize) -> f64 {
    ((7 * i + 3 * j + 11 * salt) as f64).sin()
}

/// All places of a lattice.
fn places(n: usize, m: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |i| (0..m).map(move |j| (i, j)))
}

fn nested(n: usize, m: usize, salt: usize) -> Vec<Vec<f64>> {
    let row = |i| (0..m).map(|j| given(i, j, salt)).collect();
    (0..n).map(row).collect()
}

/// Loops of one iteration, short and long ones, and tails.
const SIZES: [(usize, usize); 10] = [
    (1, 1),
    (1, 2),
    (2, 1),
    (3, 5),
    (1, 40),
    (2, 33),
    (5, 64),
    (40, 3),
    (7, 301),
    (36, 37),
];

#[test]
fn energies_and_gradients_are_those_of_sums_by_hand() {
    for (n, m) in SIZES {
        let (u, p) = (nested(n, m, 0), nested(n, m, 1));
        let (mut h, mut slopes) = (0.0, vec![vec![0.0; m]; n]);
        for (i, j) in places(n, m) {
            let below = u[(i + 1) % n][j] - u[i][j];
            let right = u[i][(j + 1) % m] - u[i][j];
            h += p[i][j].powi(2) / 2.0 + 0.75 * (1.0 - u[i][j].cos());
            h += below.powi(2) / 2.0 + right.powi(4) / 4.0;
            slopes[i][j] += 0.75 * u[i][j].sin() - below - right.powi(3);
            slopes[(i + 1) % n][j] += below;
            slopes[i][(j + 1) % m] += right.powi(3);
        }
        let system = Pendulums::new(n, m).unwrap();
        let start = State::new(u, p.clone());
        let found = system.energy(&start);
        assert!(
            (found - h).abs() <= 1e-13 * h.abs(),
            "{n} × {m}: {found} is not {h}"
        );
        let gradient = system.gradient(&start);
        for (i, j) in places(n, m) {
            let (found, due) = (gradient.q[[i, j]], slopes[i][j]);
            assert!(
                (found - due).abs() < 1e-13,
                "{n} × {m}, [{i}][{j}]: {found} is not {due}"
            );
            assert_eq!(gradient.p[[i, j]], p[i][j]);
        }
        let total: f64 = p.iter().flatten().sum();
        assert!((system.momentum(&start) - total).abs() < 1e-12);
    }
}

/// Weights of sites.
fn weights(n: usize, m: usize) -> hamiltonian::private::nalgebra::DMatrix<f64> {
    hamiltonian::private::nalgebra::DMatrix::from_fn(n, m, |i, j| 1.5 + given(i, j, 2))
}

#[test]
fn derivatives_are_those_of_duals() {
    for (n, m) in [(2, 2), (3, 5), (4, 40), (35, 6)] {
        derivatives::check(&Pendulums::new(n, m).unwrap());
        derivatives::check(&Mixed::new(n, m, weights(n, m)).unwrap());
        derivatives::check(&Coupled::new(n, m).unwrap());
    }
    derivatives::check(&Wide::<3>::default());
}

#[test]
fn lanes_have_the_bits_of_iterations_one_by_one() {
    for (n, m) in SIZES.into_iter().chain((1..=40).map(|m| (3, m))) {
        let seed = (1000 * n + m) as u64;
        bits::check(&Pendulums::new(n, m).unwrap(), seed);
        bits::check(&Coupled::new(n, m).unwrap(), seed);
        if n > 1 && m > 1 {
            bits::check(&Mixed::new(n, m, weights(n, m)).unwrap(), seed);
        }
    }
    bits::check(&Wide::<5>::default(), 1);
}

#[test]
fn the_total_momentum_of_bonds_is_proven_and_kept() {
    let system = Bonds::new(4, 37).unwrap();
    let start = State::new(nested(4, 37, 0), nested(4, 37, 1));
    let before = system.momentum(&start);
    let mut run = Integrator::new(&system, StormerVerlet::default(), start, 1e-2).unwrap();
    run.advance(100).unwrap();
    let after = system.momentum(run.state());
    assert!((after - before).abs() < 1e-12, "{before} and {after}");
}

/// The places of an array with three axes.
fn cells([n, m, k]: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    places(n, m).flat_map(move |(i, j)| (0..k).map(move |l| [i, j, l]))
}

fn solid(extents: [usize; 3], salt: usize) -> Lattice<f64, 3> {
    Lattice::from_fn(extents, |[i, j, l]| given(i + 2 * l, j, salt))
}

#[test]
fn three_axes_have_the_derivatives_of_sums_by_hand() {
    for [n, m, k] in (0..125).map(|at| [at / 25 + 1, at / 5 % 5 + 1, at % 5 + 1]) {
        let (u, v) = (solid([n, m, k], 0), solid([n, m, 3], 1));
        let (p, w) = (solid([n, m, k], 2), solid([n, m, 3], 3));
        let (mut h, mut du, mut dv) = (0.0, Lattice::zeros([n, m, k]), Lattice::zeros([n, m, 3]));
        for [i, j, l] in cells([n, m, k]) {
            let own = u[[i, j, l]];
            let [a, b, c] = [
                [(i + 1) % n, j, l],
                [i, (j + 1) % m, l],
                [i, j, (l + 1) % k],
            ];
            let (da, db) = (u[a] - own, u[b] - own);
            let far = [(i + 1) % n, (j + m - 1) % m, (l + 1) % k];
            let e = (u[c] - own).exp();
            h += p[[i, j, l]].powi(2) / 2.0 + 0.75 * (1.0 - own.cos());
            h += da * da / 2.0 + db.powi(4) / 4.0 + e + u[far] * own / 4.0 + v[[i, j, 0]] * own;
            du[[i, j, l]] += 0.75 * own.sin() - da - db.powi(3) - e + u[far] / 4.0 + v[[i, j, 0]];
            du[a] += da;
            du[b] += db.powi(3);
            du[c] += e;
            du[far] += own / 4.0;
            dv[[i, j, 0]] += own;
        }
        for [i, j, l] in cells([n, m, 3]).filter(|[_, j, _]| *j > 0) {
            let (own, before) = (v[[i, j, l]], v[[i, j - 1, l]]);
            h += w[[i, j, l]].powi(2) / 2.0 + own * before + own * own;
            dv[[i, j, l]] += before + 2.0 * own;
            dv[[i, j - 1, l]] += own;
        }
        let system = Solid::new(n, m, k).unwrap();
        let q = SolidVector::new(u, v);
        let start = State {
            q,
            p: SolidVector::new(p, w),
            t: 0.0,
        };
        let found = system.energy(&start);
        assert!(
            (found - h).abs() <= 1e-12 * h.abs().max(1.0),
            "{n} × {m} × {k}"
        );
        let gradient = system.gradient(&start);
        let pairs = [(&gradient.q.u, &du), (&gradient.q.v, &dv)];
        for (found, due) in pairs {
            let both = found.as_slice().iter().zip(due.as_slice());
            let most = both
                .map(|(a, b): (&f64, &f64)| (a - b).abs())
                .fold(0.0, f64::max);
            assert!(most < 1e-12, "{n} × {m} × {k}: {most:e}");
        }
    }
}

#[test]
fn more_axes_have_the_derivatives_of_duals_and_the_bits_of_iterations_one_by_one() {
    for (n, m, k) in [(1, 1, 1), (2, 3, 4), (3, 2, 37)] {
        let system = Solid::new(n, m, k).unwrap();
        derivatives::check(&system);
        bits::check(&system, (100 * n + 10 * m + k) as u64);
    }
    derivatives::check(&Tesseract::new(3).unwrap());
    bits::check(&Tesseract::new(4).unwrap(), 1);
}

#[test]
fn elements_of_more_axes_are_named_as_declared() {
    let system = Tesseract::new(2).unwrap();
    let at = |salt: usize| {
        Lattice::from_fn([2, 2, 2, 2], |[i, j, k, l]| {
            given(i + 4 * k, j + 2 * l, salt)
        })
    };
    let mut run = Integrator::new(
        &system,
        StormerVerlet::default(),
        State::new(at(0), at(1)),
        0.1,
    )
    .unwrap()
    .observe(Recorder::new());
    run.advance(3).unwrap();
    let columns = run.observer().columns();
    assert_eq!(
        columns[..5],
        [
            "t",
            "u[0][0][0][0]",
            "u[0][0][0][1]",
            "u[0][0][1][0]",
            "u[0][0][1][1]"
        ]
    );
    assert_eq!(columns[32], "p[1][1][1][1]");
    let other = State::new(Lattice::zeros([2, 2, 1, 2]), Lattice::zeros([2, 2, 1, 2]));
    let refused = Integrator::new(&system, StormerVerlet::default(), other, 0.1);
    assert_eq!(
        refused.expect_err("another shape").to_string(),
        "axis 2 of `u` must have the extent 2, found 1"
    );
    let error = Tesseract::new(1 << 20).unwrap_err();
    assert_eq!(
        error.to_string(),
        "`u` does not fit into memory: the sizes are too large"
    );
}

#[test]
fn extents_that_are_sizes_and_numbers_mean_the_same() {
    let (open, wide) = (Pendulums::new(3, 40).unwrap(), Wide::<3>::default());
    let start = State::new(nested(3, 40, 0), nested(3, 40, 1));
    assert_eq!(open.energy(&start), wide.energy(&start));
    assert_eq!(open.gradient(&start), wide.gradient(&start));
}

#[test]
fn schemes_of_all_kinds_keep_the_energy_at_their_order() {
    fn drift<S: System, M: Scheme<S>>(
        system: &S,
        scheme: M,
        start: &State<VectorOf<S>>,
        (h, steps): (f64, u64),
    ) -> f64 {
        let run = Integrator::new(system, scheme, start.clone(), h).unwrap();
        let mut run = run.observe(EnergyDrift::new());
        run.advance(steps).unwrap();
        run.observer().max_relative()
    }
    let system = Pendulums::new(6, 35).unwrap();
    let start = State::new(nested(6, 35, 0), nested(6, 35, 1));
    let [wide, narrow] = [(0.01, 200), (0.005, 400)]
        .map(|steps| drift(&system, StormerVerlet::default(), &start, steps));
    assert!((3.5..4.5).contains(&(wide / narrow)), "{wide} and {narrow}");
    let [wide, narrow] =
        [(0.02, 50), (0.01, 100)].map(|steps| drift(&system, Gauss::<2>::default(), &start, steps));
    assert!(
        (12.0..20.0).contains(&(wide / narrow)),
        "{wide} and {narrow}"
    );
    let coupled = Coupled::new(4, 5).unwrap();
    let start = State::new(nested(4, 5, 0), nested(4, 5, 1));
    let [wide, narrow] =
        [(0.1, 20), (0.05, 40)].map(|steps| drift(&coupled, Gauss::<2>::default(), &start, steps));
    assert!(
        (12.0..20.0).contains(&(wide / narrow)),
        "{wide} and {narrow}"
    );
}

#[test]
fn a_force_acts_on_each_site() {
    let system = Damped::new(3, 40).unwrap();
    let (u, p) = (nested(3, 40, 0), nested(3, 40, 1));
    let start = State::new(u.clone(), p.clone());
    let mut run = Integrator::new(&system, StormerVerlet::default(), start, 1e-3).unwrap();
    run.advance(1000).unwrap();
    // u̇ = p, ṗ = −u − γp
    let (damping, frequency) = (0.125f64, (1.0f64 - 0.125 * 0.125).sqrt());
    let (decay, turn) = ((-damping).exp(), frequency);
    for (i, j) in places(3, 40) {
        let rate = (p[i][j] + damping * u[i][j]) / frequency;
        let due = decay * (u[i][j] * turn.cos() + rate * turn.sin());
        let found = run.state().q[[i, j]];
        assert!(
            (found - due).abs() < 1e-6,
            "[{i}][{j}]: {found} is not {due}"
        );
    }
}

#[test]
fn elements_are_named_and_ordered_as_declared() {
    let system = Pendulums::new(2, 3).unwrap();
    let start = State::new(nested(2, 3, 0), nested(2, 3, 1));
    let flat: Vec<f64> = [nested(2, 3, 0), nested(2, 3, 1)].concat().concat();
    assert_eq!(start.to_vec(), flat);
    assert_eq!(State::from_slice(&start.q, &flat).unwrap(), start);
    let mut run = Integrator::new(&system, StormerVerlet::default(), start, 0.1)
        .unwrap()
        .observe(Recorder::new());
    run.advance(1).unwrap();
    let columns = run.observer().columns();
    assert_eq!(
        columns[..8],
        [
            "t", "u[0][0]", "u[0][1]", "u[0][2]", "u[1][0]", "u[1][1]", "u[1][2]", "p[0][0]"
        ]
    );
}

#[test]
fn starts_of_another_shape_are_refused() {
    let system = Pendulums::new(2, 3).unwrap();
    let refused = |start: State<Lattice<f64, 2>>| {
        let run = Integrator::new(&system, StormerVerlet::default(), start, 0.1);
        run.expect_err("another shape").to_string()
    };
    let turned = State::new(nested(3, 2, 0), nested(3, 2, 1));
    assert_eq!(
        refused(turned),
        "axis 0 of `u` must have the extent 2, found 3"
    );
    let narrow = State::new(nested(2, 3, 0), nested(2, 2, 1));
    assert_eq!(
        refused(narrow),
        "axis 1 of `p` must have the extent 3, found 2"
    );
    for at in 0..2 {
        let mut uneven = nested(2, 3, 0);
        uneven[at].pop();
        let error = format!("`p[{at}]` must have 3 elements, found 2");
        assert_eq!(refused(State::new(nested(2, 3, 0), uneven)), error);
    }
    // Nested lists show no extents inside an empty one.
    let none = Pendulums::new(0, 3).unwrap();
    let start = State::new(Vec::<Vec<f64>>::new(), Vec::<Vec<f64>>::new());
    assert_eq!(none.check_shape(&start), Ok(()));
}

#[test]
fn starts_of_three_axes_are_lists_and_arrays() {
    let system = Solid::new(2, 2, 3).unwrap();
    let lists = SolidVector::new(vec![vec![vec![1.0; 3]; 2]; 2], vec![[[1.0; 3]; 2]; 2]);
    let arrays = SolidVector::new([[[1.0; 3]; 2]; 2], vec![vec![[1.0; 3]; 2]; 2]);
    assert_eq!(lists, arrays);
    let start = State::new(lists.clone(), arrays);
    assert_eq!(system.check_shape(&start), Ok(()));
    let mut uneven = vec![vec![vec![1.0; 3]; 2]; 2];
    uneven[1][0].pop();
    let uneven = SolidVector::new(uneven, [[[1.0; 3]; 2]; 2]);
    let error = system.check_shape(&State::new(lists, uneven)).unwrap_err();
    assert_eq!(error.to_string(), "`p[1][0]` must have 3 elements, found 2");
}

#[test]
fn parameters_with_two_axes_are_lists_of_rows() {
    let rows = vec![vec![1.0, 2.0, 3.0], vec![4.0, 5.0, 6.0]];
    let system = Mixed::new(2, 3, rows.clone()).unwrap();
    assert_eq!((system.w()[(0, 2)], system.w()[(1, 0)]), (3.0, 4.0));
    let same = Mixed::new(2, 3, system.w().clone()).unwrap();
    assert_eq!(same.w(), system.w());
    let same = Mixed::new(2, 3, [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]).unwrap();
    assert_eq!(same.w(), system.w());
    let refused = |n, m, rows: Vec<Vec<f64>>| Mixed::new(n, m, rows).unwrap_err().to_string();
    let turned = "axis 0 of `w` must have the extent 3, found 2";
    assert_eq!(refused(3, 2, rows.clone()), turned);
    let few = "`w` must have 9 components, found 6";
    assert_eq!(refused(3, 3, rows.clone()), few);
    let mut uneven = rows;
    uneven[1].pop();
    let row = "`w[1]` must have 3 elements, found 2";
    assert_eq!(refused(2, 3, uneven), row);
}

#[test]
fn sizes_beyond_memory_are_told_by_new() {
    let memory = |error| match error {
        Error::Input(InputError::Memory { name, .. }) => name.into_string(),
        error => panic!("{error}"),
    };
    for n in [usize::MAX, 1 << 61, 1 << 60, 1 << 40] {
        assert_eq!(memory(Pendulums::new(n, 2).unwrap_err()), "u");
        assert_eq!(memory(Pendulums::new(2, n).unwrap_err()), "u");
        assert_eq!(memory(Pendulums::new(n, n).unwrap_err()), "u");
        assert_eq!(memory(Solid::new(1, 1, n).unwrap_err()), "u");
        // The other coordinates have no axis of this extent.
        assert_eq!(memory(Solid::new(n, 1, 0).unwrap_err()), "v");
        assert_eq!(memory(Pairs::new(n).unwrap_err()), "q");
        assert_eq!(memory(Bodies::new(n).unwrap_err()), "q");
        // No array has so many elements, and none is asked for.
        let weights = Weighed::new(1, n, vec![vec![1.0; 2]]).unwrap_err();
        assert!(
            matches!(weights, Error::Input(InputError::Shape { name, expected, found: 2, .. }) if (&*name, expected) == ("w", n))
        );
        let weights = Weighed::new(8, n | 1 << 61, vec![vec![1.0; 2]]).unwrap_err();
        assert_eq!(memory(weights), "w");
    }
    assert!(Pendulums::new(usize::MAX, 0).is_ok());
    assert_eq!(
        Pairs::new(1 << 40).unwrap_err().to_string(),
        "`q` does not fit into memory: the sizes are too large"
    );
}

hamiltonian! {
    /// Indices whose check takes the longer the more sites there are.
    pub struct Pairs { n: usize }
    H(q[n]; p[n]) = norm_squared(p)/2
        + sum(i in 0..n, j in i + 1..n, k in j + 3..n) { q[i + k - j]*q[j] }
}

hamiltonian! {
    /// Rows of three.
    pub struct Bodies { n: usize }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/2 + norm(q[i]) }
}

hamiltonian! {
    /// An extent of parameters alone.
    pub struct Weighed { n: usize, k: usize, w: [n][k] }
    H(q[n]; p[n]) = norm_squared(p)/2 + sum(i in 0..n, j in 0..k) { w[i][j]*q[i]^2 }
}

hamiltonian! {
    /// A Lagrangian: masses of sites depend on the field there, and a scalar acts on all sites.
    pub struct Action { n: usize, m: usize, mass = 2.0 }
    L(x, u[n][m]; y, v[n][m]) = y^2/2 + sum(i in 0..n, j in 0..m) {
        mass*(1 + u[i][j]^2)*v[i][j]^2/2 - (u[(i + 1) % n][j] - u[i][j])^2/2 - x*u[i][j]
    }
}

hamiltonian! {
    /// The same, transformed by hand.
    pub struct Transformed { n: usize, m: usize, mass = 2.0 }
    H(x, u[n][m]; y, p[n][m]) = y^2/2 + sum(i in 0..n, j in 0..m) {
        p[i][j]^2/(2*mass*(1 + u[i][j]^2)) + (u[(i + 1) % n][j] - u[i][j])^2/2 + x*u[i][j]
    }
}

hamiltonian! {
    /// Few enough elements to be coupled by their velocities.
    pub struct Few {}
    L(u[2][2][2]; v[2][2][2]) = sum(i in 0..2, j in 0..2, k in 0..2) {
        v[i][j][k]^2/2 + v[i][j][k]*v[i][j][1 - k]/4
    }
}

#[test]
fn lagrangians_of_lattices_have_the_hamiltonians_by_hand() {
    for (n, m) in [(1, 1), (3, 5), (2, 40)] {
        let (u, p) = (nested(n, m, 0), nested(n, m, 1));
        let (found, due) = (Action::new(n, m).unwrap(), Transformed::new(n, m).unwrap());
        let vector = |x, u: &Vec<Vec<f64>>| ActionVector::new(x, u.clone());
        let state = State::new(vector(0.5, &u), vector(0.25, &p));
        let vector = |x, u: &Vec<Vec<f64>>| TransformedVector::new(x, u.clone());
        let same = State::new(vector(0.5, &u), vector(0.25, &p));
        let (found, due) = (found.gradient(&state), due.gradient(&same));
        let found = found.q.components().chain(found.p.components());
        let due = due.q.components().chain(due.p.components());
        for (at, (found, due)) in found.zip(due).enumerate() {
            assert!((found - due).abs() < 1e-14, "{at}: {found} is not {due}");
        }
    }
    let action = Action::new(2, 3).unwrap();
    let (x, v) = (nested(2, 3, 0), nested(2, 3, 1));
    let [q, velocities] = [&x, &v].map(|u| ActionVector::new(0.5, u.clone()));
    let start = action.state_from_velocity(0.0, q, velocities);
    for (i, j) in places(2, 3) {
        let due = 2.0 * (1.0 + x[i][j].powi(2)) * v[i][j];
        assert!((start.p.u[[i, j]] - due).abs() < 1e-15);
    }
    // M = (1 ½; ½ 1) for each pair.
    let p = Lattice::from_fn([2, 2, 2], |[i, j, k]| given(i + 2 * j, k, 3));
    let pairs = places(2, 2).map(|(i, j)| (p[[i, j, 0]], p[[i, j, 1]]));
    let due: f64 = pairs.map(|(a, b)| (a * a - a * b + b * b) / 1.5).sum();
    let found = Few {}.energy(&State::new(Lattice::zeros([2, 2, 2]), p));
    assert!((found - due).abs() < 1e-14, "{found} is not {due}");
}

hamiltonian! {
    /// Two rows of parameters.
    pub struct Rows { n: usize, w: [2][n] }
    H(q[n]; p[n]) = sum(i in 0..n) { w[0][i]*p[i]^2/2 + w[1][i]*q[i]^2/2 }
}

#[test]
fn parameters_may_have_as_many_rows_as_a_number_says() {
    let system = Rows::new(3, [vec![1.0, 2.0, 3.0], vec![4.0, 5.0, 6.0]]).unwrap();
    let state = State::new(vec![0.0, 2.0, 0.0], vec![0.0, 0.0, 4.0]);
    assert_eq!(system.energy(&state), 10.0 + 24.0);
    let error = Rows::new(3, vec![vec![1.0; 3]; 3]).unwrap_err();
    assert_eq!(error.to_string(), "`w` must have 6 components, found 9");
}

hamiltonian! {
    /// An exact flow at each site.
    pub struct Shears { n: usize, m: usize }
    H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) { (i + 2*j + 1)*p[i][j]*u[i][j] }
}

#[test]
fn exact_flows_act_on_each_site() {
    let system = Shears::new(3, 5).unwrap();
    let start = State::new(nested(3, 5, 0), nested(3, 5, 1));
    let mut run = Integrator::new(&system, Strang, start.clone(), 0.125).unwrap();
    run.advance(8).unwrap();
    for (i, j) in places(3, 5) {
        let growth = f64::from((i + 2 * j + 1) as u32).exp();
        let (q, p) = (run.state().q[[i, j]], run.state().p[[i, j]]);
        assert!((q - growth * start.q[[i, j]]).abs() < 1e-13 * growth);
        assert!((p - start.p[[i, j]] / growth).abs() < 1e-13);
    }
}
