//! Stages of a separable H: forces are computed from the new velocities, which takes about half the iterations.

use hamiltonian::prelude::*;
use std::cell::Cell;

thread_local! {
    /// The evaluations of [`well`] on this thread.
    static CALLS: Cell<u64> = const { Cell::new(0) };
}

/// x⁴/4 − cos x, counted.
fn well<T: Real>(x: T) -> T {
    CALLS.set(CALLS.get() + 1);
    (x * x) * (x * x) * T::constant(0.25, 0.0) - x.cos()
}

hamiltonian! {
    /// Separable, with a kinetic energy that is not quadratic.
    struct Apart {}
    fn V(x) = well;
    H(q; p) = sqrt(1 + p^2) + V(q)
}

hamiltonian! {
    /// The same for c = 0, which is not known when this is compiled.
    struct Together { c }
    fn V(x) = well;
    H(q; p) = sqrt(1 + p^2) + V(q) + c*q*p
}

/// The end of 200 steps, and the evaluations of the potential meanwhile.
fn run<S: System>(
    system: &S,
    scheme: impl Scheme<S>,
    start: StateOf<S>,
    lanes: bool,
) -> ([f64; 2], u64) {
    let run = Integrator::new(system, scheme, start, 0.25).unwrap();
    let mut run = run.with_lanes(lanes);
    CALLS.set(0);
    let end = run.advance(200).unwrap();
    ([end.q.component(0), end.p.component(0)], CALLS.get())
}

#[test]
fn velocities_come_before_forces_where_h_is_separable() {
    fn check<M: Scheme<Apart> + Scheme<Together>>(scheme: M) {
        let start = || State::new([1.1], [0.2]);
        let (apart, few) = run(&Apart {}, scheme.clone(), start(), false);
        assert_eq!(run(&Apart {}, scheme.clone(), start(), true).0, apart);
        let (together, many) = run(&Together { c: 0.0 }, scheme.clone(), start(), false);
        let name = scheme.entry();
        for (a, b) in apart.iter().zip(together) {
            assert!((a - b).abs() < 1e-12, "{name}: {apart:?}, {together:?}");
        }
        println!("{name}: {few} evaluations, else {many}");
        assert!(5 * few < 4 * many, "{name}: {few}, {many}");
    }
    check(ImplicitMidpoint::default());
    check(Gauss::<2>::default());
    check(Gauss::<4>::default());
    check(Gauss::<8>::default());
}
