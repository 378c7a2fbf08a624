//! Indices that only the sizes keep in range, of sizes set at run time: `new` checks them. Const generics are checked by
//! rustc (`toolchain/sizes.rs`).

use hamiltonian::analysis::{Branch, momentum_from_energy};
use hamiltonian::errors::InputError;
use hamiltonian::prelude::*;

hamiltonian! {
    /// Reads an element that short lattices do not have, and ends that empty ones do not.
    pub struct Pinned { n: usize }
    H(q[n]; p[n]) = norm_squared(p)/2 + q[3]^2 + q[n - 1]^4
}

hamiltonian! {
    /// As many masses as somebody else says.
    pub struct Weighed { n: usize, k: usize, m: [k] }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/(2*m[i]) }
}

hamiltonian! {
    /// The last iterations that take place are not at the ends of both ranges: i + 3 ≤ j < n.
    pub struct Pairs { n: usize }
    H(q[n]; p[n]) = norm_squared(p)/2 + sum(i in 0..n, j in i + 3..n) { q[i + j - 3]*q[j - i] }
}

hamiltonian! {
    /// A range that is to end where the lattice does.
    pub struct Tail { n: usize }
    H(q[n]; p[n]) = norm_squared(p)/2 + sum(i in n - 3..n) { exp(q[i]) }
}

hamiltonian! {
    /// Goes round by another size than its own.
    pub struct Around { n: usize, k: usize }
    H(q[n]; p[n]) = norm_squared(p)/2 + sum(i in 0..n) { q[i]*q[(i + 1) % k] } + q[(n + 1) % k]
}

hamiltonian! {
    /// A piece reads the sizes and arrays of the whole.
    pub struct Split { n: usize }
    H(q[n]; p[n]) = norm_squared(p)/2 + q[2]^2;
    split { Kinetic = norm_squared(p)/2; Potential = q[2]^2 }
}

hamiltonian! {
    /// Several groups.
    pub struct Mixed { n: usize }
    H(x, z[n], r[n][2]; p_x, p_z[n], p_r[n][2]) = p_x^2 + x*norm_squared(z)
        + sum(i in 0..n) { norm_squared(p_r[i]) + dot(r[i], p_r[i]) + p_z[i]^2 }
}

hamiltonian! {
    /// Others than the first are relative to it.
    pub struct AroundFirst { n: usize, m: [n] }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/(2*m[i]) } + sum(i in 1..n, j in 0..i) { (q[i] - q[j])^2 };
    coordinates heliocentric(q, m)
}

/// The index that is refused, the value that it reaches, and the extent.
fn index(error: Error) -> (String, i64, usize) {
    match error {
        Error::Input(InputError::Index {
            expression,
            reached,
            extent,
            ..
        }) => (expression.into_string(), reached, extent),
        error => panic!("{error}"),
    }
}

#[test]
fn sizes_of_run_time_are_asked_by_new() {
    assert_eq!(index(Pinned::new(3).unwrap_err()), ("q[3]".into(), 3, 3));
    let least = State::new(vec![0.0, 0.0, 0.5, 2.0], vec![0.0; 4]);
    assert_eq!(Pinned::new(4).unwrap().energy(&least), 20.0);
    let masses = |k| vec![0.5; k];
    assert_eq!(
        index(Weighed::new(3, 2, masses(2)).unwrap_err()),
        ("m[i]".into(), 2, 2)
    );
    let ones = State::new(vec![0.0; 3], vec![1.0; 3]);
    assert_eq!(Weighed::new(3, 4, masses(4)).unwrap().energy(&ones), 3.0);
    let mut given = masses(4);
    given[2] = f64::NAN;
    assert_eq!(
        Weighed::new(3, 4, given).unwrap_err().to_string(),
        "the parameter `m[2]` is NaN, and must be a number"
    );
    // Sizes first: where a size does not fit, the number of masses is not the reason.
    assert_eq!(
        index(Weighed::new(3, 2, masses(3)).unwrap_err()),
        ("m[i]".into(), 2, 2)
    );
    assert_eq!(
        Split::new(2).unwrap_err().to_string(),
        "`q[2]` reaches 2, but the extent is 2: the sizes do not fit"
    );
    assert!(SplitPotential::new(2).is_err() && Split::new(3).is_ok());
}

#[test]
fn bodies_around_the_first_are_not_none() {
    assert_eq!(
        index(AroundFirst::new(0, Vec::<f64>::new()).unwrap_err()),
        ("q[0]".into(), 0, 0)
    );
    let one = AroundFirst::new(1, vec![2.0]).unwrap();
    let there = one.from_declared(&State::new(vec![3.0], vec![2.0]));
    assert_eq!(one.energy(&there), 1.0);
}

#[test]
fn iterations_that_do_not_take_place_reach_nothing() {
    // i = n - 4, j = n - 1.
    assert_eq!(
        index(Pairs::new(8).unwrap_err()),
        ("q[i + j - 3]".into(), 8, 8)
    );
    for n in [0, 3, 4, 7] {
        let pairs = Pairs::new(n).unwrap();
        let q: Vec<f64> = (0..n).map(|i| i as f64).collect();
        let written = || (0..n).flat_map(|i| (i + 3..n).map(move |j| (i + j - 3, j - i)));
        let energy: usize = written().map(|(first, second)| first * second).sum();
        let mut slopes = vec![0.0; n];
        for (first, second) in written() {
            slopes[first] += second as f64;
            slopes[second] += first as f64;
        }
        let state = State::new(q, vec![0.0; n]);
        assert_eq!(pairs.energy(&state), energy as f64);
        assert_eq!(pairs.gradient(&state).q.as_slice(), slopes);
    }
}

#[test]
fn ranges_of_run_time_begin_at_0() {
    let error = Tail::new(2).unwrap_err();
    let Error::Input(InputError::Range {
        expression,
        reached,
        ..
    }) = error
    else {
        panic!("{error}");
    };
    assert_eq!((&*expression, reached), ("i in n - 3..n", -1));
    let state = State::new(vec![0.0; 5], vec![2.0; 5]);
    assert_eq!(Tail::new(5).unwrap().energy(&state), 13.0);
}

#[test]
fn moduli_of_run_time_are_extents() {
    assert_eq!(
        index(Around::new(2, 3).unwrap_err()),
        ("q[(i + 1) % k]".into(), 2, 2)
    );
    assert_eq!(
        index(Around::new(2, 0).unwrap_err()),
        ("q[(i + 1) % k]".into(), -1, 2)
    );
    let state = State::new(vec![1.0, 2.0, 3.0], vec![0.0; 3]);
    // q₀q₁ + q₁q₀ + q₂q₁ + q₀.
    assert_eq!(Around::new(3, 2).unwrap().energy(&state), 11.0);
}

#[test]
fn states_of_another_length_are_errors() {
    let shape = |error| match error {
        Error::Input(InputError::Shape {
            name,
            expected,
            found,
            ..
        }) => (name.into_string(), expected, found),
        error => panic!("{error}"),
    };
    let system = Weighed::new(3, 3, vec![1.0; 3]).unwrap();
    let state = |q, p| State::new(vec![1.0; q], vec![1.0; p]);
    assert_eq!(system.check_shape(&state(3, 3)), Ok(()));
    let long = state(4, 3);
    assert_eq!(
        shape(system.check_shape(&long).unwrap_err()),
        ("q".into(), 3, 4)
    );
    let short = state(3, 2);
    let error = system.check_shape(&short).unwrap_err();
    assert_eq!(error.to_string(), "`p` must have 3 components, found 2");
    let started = momentum_from_energy(&system, &short, 0, 1.0, Branch::Nearest);
    assert_eq!(shape(started.unwrap_err()), ("p".into(), 3, 2));
    let run = Integrator::new(&system, RungeKutta4, long, 0.1);
    assert_eq!(shape(run.map(|_| ()).unwrap_err()), ("q".into(), 3, 4));
    // Without a check before, the panic has both lengths.
    let panic = std::panic::catch_unwind(|| system.gradient(&state(4, 4))).unwrap_err();
    let text = panic.downcast_ref::<String>().expect("it is formatted");
    assert!(
        text.contains("has 4 elements where the system has 3×1") && text.contains("check_shape"),
        "{text}"
    );
    // Of mixed shape, by the name of the group.
    let mixed = Mixed::new(2).unwrap();
    let vector = |n: usize| MixedVector::new(1.0, vec![1.0; n], vec![[1.0, 2.0]; n]);
    assert_eq!(mixed.check_shape(&State::new(vector(2), vector(2))), Ok(()));
    let state = State::new(
        MixedVector::new(1.0, vec![1.0; 2], vec![[1.0; 2]; 3]),
        vector(2),
    );
    assert_eq!(
        shape(mixed.check_shape(&state).unwrap_err()),
        ("r".into(), 4, 6)
    );
}
