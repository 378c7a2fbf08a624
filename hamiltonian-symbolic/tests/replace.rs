//! A loop variable is replaced where it is free, and only there.

use crate::common::{model, parse};
use hamiltonian_symbolic::dag::Kind;
use hamiltonian_symbolic::index::Affine;
use hamiltonian_symbolic::print::text;

#[test]
fn a_sum_over_the_same_loop_keeps_its_variable() {
    let mut m = model("q[N]; p[N]", "N", "");
    let sum = parse(
        &mut m,
        "sum(i in 0..N) { exp(p[i] + sum(i in 0..N) { q[i] })*q[i] }",
    );
    let Kind::Reduce(domain, body) = *m.dag.kind(sum) else {
        panic!()
    };
    let moved = m.dag.replace(body, domain, &Affine::constant(1));
    assert_eq!(text(&m, moved), "exp(p[1] + sum(i in 0..N) { q[i] })*q[1]");
}

#[test]
fn loops_inside_move_along() {
    let mut m = model("q[N]; p[N]", "N", "");
    let sum = parse(
        &mut m,
        "sum(i in 0..N) { p[i]*sum(j in 0..i) { q[i]*q[j] } }",
    );
    let Kind::Reduce(domain, body) = *m.dag.kind(sum) else {
        panic!()
    };
    let by = Affine::variable(domain).plus(1, &Affine::constant(1));
    let moved = m.dag.replace(body, domain, &by);
    let again = m.dag.reduce(domain, moved);
    assert_eq!(
        text(&m, again),
        "sum(i in 0..N) { p[i + 1]*q[i + 1]*sum(j in 0..i + 1) { q[j] } }"
    );
}
