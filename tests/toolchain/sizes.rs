//! Indices that only the sizes keep in range, of const generics: rustc checks them when it compiles the code.

use crate::cargo::{Package, workspace, write};
use std::fs;

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
