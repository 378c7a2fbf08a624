//! Indices that only the sizes keep in range: const generics are asked when code is compiled,
//! sizes set at run time by `new`.

use crate::cargo::{Package, workspace, write};
use hamiltonian::prelude::*;
use hamiltonian::start::{Branch, momentum_from_energy};
use std::fs;

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

fn index(index: &'static str, reached: i64, extent: usize) -> Error {
    Error::Index {
        index,
        reached,
        extent,
    }
}

#[test]
fn sizes_of_run_time_are_asked_by_new() {
    assert_eq!(Pinned::new(3).unwrap_err(), index("q[3]", 3, 3));
    let least = State::new(vec![0.0, 0.0, 0.5, 2.0], vec![0.0; 4]);
    assert_eq!(Pinned::new(4).unwrap().energy(&least), 20.0);
    let masses = |k| vec![0.5; k];
    assert_eq!(
        Weighed::new(3, 2, masses(2)).unwrap_err(),
        index("m[i]", 2, 2)
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
        Weighed::new(3, 2, masses(3)).unwrap_err(),
        index("m[i]", 2, 2)
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
        AroundFirst::new(0, Vec::<f64>::new()).unwrap_err(),
        index("q[0]", 0, 0)
    );
    let one = AroundFirst::new(1, vec![2.0]).unwrap();
    let there = one.from_declared(&State::new(vec![3.0], vec![2.0]));
    assert_eq!(one.energy(&there), 1.0);
}

#[test]
fn iterations_that_do_not_take_place_reach_nothing() {
    // i = n - 4, j = n - 1.
    assert_eq!(Pairs::new(8).unwrap_err(), index("q[i + j - 3]", 8, 8));
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
    assert_eq!(
        Tail::new(2).unwrap_err(),
        Error::Range {
            range: "i in n - 3..n",
            first: -1
        }
    );
    let state = State::new(vec![0.0; 5], vec![2.0; 5]);
    assert_eq!(Tail::new(5).unwrap().energy(&state), 13.0);
}

#[test]
fn moduli_of_run_time_are_extents() {
    assert_eq!(
        Around::new(2, 3).unwrap_err(),
        index("q[(i + 1) % k]", 2, 2)
    );
    assert_eq!(
        Around::new(2, 0).unwrap_err(),
        index("q[(i + 1) % k]", -1, 2)
    );
    let state = State::new(vec![1.0, 2.0, 3.0], vec![0.0; 3]);
    // q₀q₁ + q₁q₀ + q₂q₁ + q₀.
    assert_eq!(Around::new(3, 2).unwrap().energy(&state), 11.0);
}

#[test]
fn states_of_another_length_are_errors() {
    let shape = |name, expected, found| Error::Shape {
        name,
        expected,
        found,
    };
    let system = Weighed::new(3, 3, vec![1.0; 3]).unwrap();
    let state = |q, p| State::new(vec![1.0; q], vec![1.0; p]);
    assert_eq!(system.check_shape(&state(3, 3)), Ok(()));
    let long = state(4, 3);
    assert_eq!(system.check_shape(&long), Err(shape("q", 3, 4)));
    let short = state(3, 2);
    let error = system.check_shape(&short).unwrap_err();
    assert_eq!(error.to_string(), "`p` must have 3 components, found 2");
    let started = momentum_from_energy(&system, &short, 0, 1.0, Branch::Nearest);
    assert_eq!(started.unwrap_err(), shape("p", 3, 2));
    let run = Integrator::new(&system, RungeKutta4, long, 0.1);
    assert_eq!(run.map(|_| ()).unwrap_err(), shape("q", 3, 4));
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
    assert_eq!(mixed.check_shape(&state), Err(shape("r", 4, 6)));
}

/// A definition and how it is used; where the error is, and what it says.
struct Case {
    name: &'static str,
    source: &'static str,
    error: Option<(&'static str, &'static str)>,
}

const CASES: &[Case] = &[
    Case {
        name: "pinned",
        source: "
hamiltonian! {
    pub struct Pinned<const N: usize> {}
    H(q[N]; p[N]) = norm_squared(p)/2 + q[3]^2
}
fn main() { println!(\"{}\", Pinned::<3> {}.energy(&State::new([0.0; 3], [0.0; 3]))) }",
        error: Some((
            "4:43",
            "`q[3]` is out of range for these sizes: indices there run from 0 to N - 1",
        )),
    },
    Case {
        name: "pinned_well",
        source: "
hamiltonian! {
    pub struct Pinned<const N: usize> {}
    H(q[N]; p[N]) = norm_squared(p)/2 + q[3]^2
}
fn main() { println!(\"{}\", Pinned::<4> {}.energy(&State::new([0.0; 4], [0.0; 4]))) }",
        error: None,
    },
    Case {
        name: "weighed",
        source: "
hamiltonian! {
    pub struct Weighed<const N: usize, const M: usize> { m: [M] }
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/(2*m[i]) }
}
fn main() { println!(\"{}\", Weighed::<4, 2>::new([1.0; 2]).energy(&State::new([0.0; 4], [0.0; 4]))) }",
        error: Some((
            "4:50",
            "`m[i]` is out of range for these sizes: indices there run from 0 to M - 1",
        )),
    },
    Case {
        name: "tail",
        source: "
hamiltonian! {
    pub struct Tail<const N: usize> {}
    H(q[N]; p[N]) = norm_squared(p)/2 + sum(i in N - 3..N) { exp(i*q[0]) }
}
fn main() { println!(\"{}\", Tail::<2> {}.gradient(&State::new([0.0; 2], [0.0; 2])).q[0]) }",
        error: Some(("4:50", "`i in N - 3..N` begins below 0 for these sizes")),
    },
    Case {
        name: "twice",
        source: "
hamiltonian! {
    pub struct Twice<const N: usize> {}
    H(q; p) = p^2/2 + sum(i in 0..2*N) { q^2 }
}
fn main() { println!(\"{}\", Twice::<{ 1 << (usize::BITS - 1) }> {}.energy(&State::new([0.0], [0.0]))) }",
        error: Some((
            "4:35",
            "`2*N` does not fit into memory: the sizes are too large",
        )),
    },
    Case {
        name: "around_first",
        source: "
hamiltonian! {
    pub struct AroundFirst<const N: usize> { m: [N] }
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/(2*m[i]) };
    coordinates heliocentric(q, m)
}
fn main() { println!(\"{}\", AroundFirst::<0>::new([0.0; 0]).from_declared(&State::new([0.0; 0], [0.0; 0])).t) }",
        error: Some((
            "5:30",
            "`q[0]` is out of range for these sizes: indices there run from 0 to N - 1",
        )),
    },
    Case {
        // Inner loops that are empty at the ends of the outer ones, so that these are run.
        name: "long_well",
        source: "
hamiltonian! {
    pub struct Long<const N: usize, const M: usize> {}
    H(q[M]; p[M]) = norm_squared(p)/2 + sum(i in 0..N, j in i + 1..N, k in j + 1..N) { q[k]*q[j]*q[i] }
}
fn main() { println!(\"{}\", Long::<4000, 4001> {}.energy(&State::new([0.0; 4001], [0.0; 4001]))) }",
        error: None,
    },
    Case {
        // Nothing is reached where j is out of range: 6 > i ≥ 0, 6 > j ≥ i + 4, 2 ≥ i, 5 ≥ j.
        name: "value_well",
        source: "
fn main() {
    let value = hamiltonian! {
        H(q[6]; p[6]) = norm_squared(p)/2 + sum(i in 0..6, j in i + 4..6) { q[i + j - 3]*q[i] }
    };
    println!(\"{}\", value.energy(&State::new([0.0; 6], [0.0; 6])))
}",
        error: None,
    },
    Case {
        name: "value",
        source: "
fn main() {
    let value = hamiltonian! {
        H(q[6]; p[6]) = norm_squared(p)/2 + sum(i in 0..6, j in i + 4..6) { q[i + j]*q[i] }
    };
    println!(\"{}\", value.energy(&State::new([0.0; 6], [0.0; 6])))
}",
        error: Some((
            "4:79",
            "`q[i + j]` is out of range for these sizes: indices there run from 0 to 5",
        )),
    },
];

/// The errors come when code is made for certain sizes, which `cargo check` does not do.
#[test]
fn const_generics_are_asked_when_compiled() {
    let workspace = workspace("sizes", &[Package::new("sizes", "")]);
    let programs = workspace.path.join("sizes/src/bin");
    fs::create_dir_all(&programs).expect("the target directory can be written to");
    for case in CASES {
        let source = format!("use hamiltonian::prelude::*;{}\n", case.source);
        write(&programs.join(format!("{}.rs", case.name)), &source);
    }
    let said = workspace
        .cargo(&["build", "--keep-going", "--message-format=short"])
        .text;
    for case in CASES {
        let place = format!("/{}.rs:", case.name);
        let errors: Vec<&str> = said
            .lines()
            .filter(|line| line.contains(&place) && line.contains(": error"))
            .collect();
        match case.error {
            None => assert!(errors.is_empty(), "{}: {said}", case.name),
            Some((at, due)) => assert!(
                matches!(&errors[..], [error] if error.contains(at) && error.contains(due)),
                "{}: {said}",
                case.name
            ),
        }
    }
    // Every program was looked at.
    let failed = CASES.iter().filter(|case| case.error.is_some());
    let failures = said.matches("could not compile `sizes`").count();
    assert_eq!(failures, failed.count(), "{said}");
}
