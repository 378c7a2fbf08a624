//! Compositions, adjoints and splittings into any number of pieces: order, form, symmetry, bits.

use crate::common::pieces::{Loops, Polar};
use crate::common::systems::*;
use crate::common::{difference, start};
use hamiltonian_core::VectorOf;
use hamiltonian_core::prelude::*;
use hamiltonian_core::schemes::author::{Reversed, Splitting, Weight};
use hamiltonian_core::schemes::{Adjoint, Composition, KahanLi6, Pihajoki, SymplecticEuler};
use hamiltonian_core::{DoubleDouble, Scheme, Vector, schemes::author::OneStep};

/// The slope of the error at t = 1 between two steps, in double-double, against Gauss's method of order 16, whose
/// error is below a thousandth of any here.
pub fn slope<S, M>(system: &S, scheme: M, q: &[f64], p: &[f64]) -> f64
where
    S: System,
    M: Scheme<S>,
{
    let start = start::<DoubleDouble, S>(system, q, p);
    let h = |n: u64| DoubleDouble::one() / DoubleDouble::from(n as f64);
    let mut exact = Integrator::new(system, Gauss::<8>::default(), start.clone(), h(64)).unwrap();
    let exact = exact.advance(64).unwrap();
    let error = |n: u64| {
        let mut run = Integrator::new(system, scheme.clone(), start.clone(), h(n)).unwrap();
        difference(run.advance(n).unwrap(), exact)
    };
    (error(64) / error(128)).log2()
}

#[track_caller]
pub fn is(order: f64, slope: f64) {
    assert!((slope - order).abs() < 0.05, "{slope} instead of {order}");
}

#[test]
fn yoshidas_composition_of_a_symmetric_scheme_has_order_4() {
    let (q, p) = (&[1.1][..], &[0.7][..]);
    let relativistic = Hand(Relativistic);
    macro_rules! of_both_orders {
        ($($verlet:expr),+) => {$(
            is(2.0, slope(&relativistic, $verlet, q, p));
            is(4.0, slope(&relativistic, Composition::yoshida($verlet), q, p));
        )+};
    }
    of_both_orders!(StormerVerlet::KickDriftKick, StormerVerlet::DriftKickDrift);
    let midpoint = Composition::yoshida(ImplicitMidpoint::default());
    is(4.0, slope(&relativistic, midpoint, q, p));
    is(4.0, slope(&Hand(Paper34), midpoint, &[0.9], &[0.4]));
    // Both halves depend on time.
    is(4.0, slope(&Hand(Pumped), midpoint, q, p));
    let strang = Composition::yoshida(Strang);
    is(4.0, slope(&Hand(Pumped), strang, q, p));
    let copies = Composition::yoshida(Pihajoki::default());
    is(4.0, slope(&Hand(Paper34), copies, &[0.9], &[0.4]));
    // A composition is a scheme to compose: order 6 of order 4 by the same cube-root trick.
    let root = 2f64.powf(0.2);
    let outer = 1.0 / (2.0 - root);
    let weights = [outer, 1.0 - 2.0 * outer, outer].map(|weight| Weight(weight, 0.0));
    let sixth = Composition::new(strang, weights, 6, "triple jump");
    is(6.0, slope(&Hand(Pumped), sixth, q, p));
    // A scheme that is not symmetric gains one order at most, here none: the control, for which `yoshida`
    // does not compile. With its adjoint it is symmetric.
    let root = 2f64.cbrt();
    let outer = 1.0 / (2.0 - root);
    let weights = [outer, 1.0 - 2.0 * outer, outer].map(|weight| Weight(weight, 0.0));
    for euler in [SymplecticEuler::KickDrift, SymplecticEuler::DriftKick] {
        let alone = Composition::new(euler, weights, 4, "triple jump");
        is(1.0, slope(&relativistic, alone, q, p));
        let both = Composition::with_adjoint(euler);
        assert_eq!(both.adjoint(), both);
        is(4.0, slope(&relativistic, Composition::yoshida(both), q, p));
        is(6.0, slope(&relativistic, KahanLi6.of(both), q, p));
    }
}

/// The distance of the derivative M of some steps from symplectic: the largest component of MᵀJM − J.
fn asymplecticity<S, M>(system: &S, scheme: M, q: &[f64], p: &[f64]) -> f64
where
    S: System,
    M: Scheme<S>,
{
    let n = q.len();
    let column = |k: usize| {
        let mut moved = start::<Dual<f64>, S>(system, q, p);
        let place = if k < n {
            moved.q.component_mut(k)
        } else {
            moved.p.component_mut(k - n)
        };
        *place = Dual::variable(place.re);
        let step = Dual::fixed(0.05);
        let mut run = Integrator::new(system, scheme.clone(), moved, step).unwrap();
        let end = run.advance(20).unwrap();
        let slopes = end.q.components().chain(end.p.components());
        slopes.map(|x| x.eps).collect::<Vec<_>>()
    };
    let columns: Vec<_> = (0..2 * n).map(column).collect();
    let mut largest = 0.0_f64;
    for (i, a) in columns.iter().enumerate() {
        for (j, b) in columns.iter().enumerate() {
            let form: f64 = (0..n).map(|k| a[k] * b[k + n] - a[k + n] * b[k]).sum();
            let exact = f64::from(i8::from(j == i + n)) - f64::from(i8::from(i == j + n));
            largest = largest.max((form - exact).abs());
        }
    }
    largest
}

#[test]
fn strang_of_three_and_of_four_pieces() {
    let (q, p) = (&[0.4, 0.7][..], &[0.2, 0.15][..]);
    is(2.0, slope(&Hand(Polar::<3>), Strang, q, p));
    is(2.0, slope(&Hand(Polar::<4>), Strang, q, p));
    let fourth = Composition::yoshida(Strang);
    is(4.0, slope(&Hand(Polar::<3>), fourth, q, p));
    is(4.0, slope(&Hand(Polar::<4>), fourth, q, p));
    let three = asymplecticity(&Hand(Polar::<3>), Strang, q, p);
    let four = asymplecticity(&Hand(Polar::<4>), Strang, q, p);
    let composed = asymplecticity(&Hand(Polar::<4>), fourth, q, p);
    assert!(three <= 1e-13 && four <= 1e-13, "{three:e} {four:e}");
    assert!(composed <= 1e-13, "{composed:e}");
    // The control.
    assert!(asymplecticity(&Hand(Polar::<3>), RungeKutta4, q, p) > 1e-10);
}

/// A loop of terms that do not commute is turned round on the way up, wherever it stands.
#[test]
fn loops_are_turned() {
    fn check<const PLACE: usize, const TURNS: bool>() -> (f64, f64, f64)
    where
        Hand<Loops<PLACE, TURNS>, 2>: Split,
    {
        let system = Hand(Loops::<PLACE, TURNS>);
        let (q, p) = ([0.5, -0.4], [0.3, 0.8]);
        let order = slope(&system, Strang, &q, &p);
        let begin = start::<f64, _>(&system, &q, &p);
        let mut there = Integrator::new(&system, Strang, begin.clone(), 0.05).unwrap();
        let end = there.advance(40).unwrap().clone();
        let mut back = Integrator::new(&system, Strang, end, -0.05).unwrap();
        let symmetry = difference(back.advance(40).unwrap(), &begin);
        (order, symmetry, asymplecticity(&system, Strang, &q, &p))
    }
    for (order, symmetry, form) in [check::<0, true>(), check::<1, true>(), check::<2, true>()] {
        is(2.0, order);
        assert!(symmetry <= 1e-13 && form <= 1e-13, "{symmetry:e} {form:e}");
    }
    // Never turned, it is of order 1 and does not come back.
    for (order, symmetry, _) in [
        check::<0, false>(),
        check::<1, false>(),
        check::<2, false>(),
    ] {
        is(1.0, order);
        assert!(symmetry > 1e-4, "{symmetry:e}");
    }
}

/// A state after `n` steps.
fn after<S: System, M: Scheme<S>>(
    system: &S,
    scheme: M,
    start: &State<VectorOf<S>>,
    h: f64,
    n: u64,
) -> State<VectorOf<S>> {
    let mut run = Integrator::new(system, scheme, start.clone(), h).unwrap();
    run.advance(n).unwrap().clone()
}

#[test]
fn the_adjoint_of_the_adjoint_is_the_scheme() {
    let bits = |table: &dyn Fn() -> Vec<(Weight, Weight)>| {
        (table().iter())
            .map(|(down, up)| [down.0, down.1, up.0, up.1].map(f64::to_bits))
            .collect::<Vec<_>>()
    };
    for euler in [SymplecticEuler::KickDrift, SymplecticEuler::DriftKick] {
        let adjoint = bits(&|| Reversed(euler).stages().to_vec());
        assert_eq!(adjoint, bits(&|| euler.adjoint().stages().to_vec()));
        assert_ne!(adjoint, bits(&|| euler.stages().to_vec()));
        let twice = bits(&|| Reversed(Reversed(euler)).stages().to_vec());
        assert_eq!(twice, bits(&|| euler.stages().to_vec()));
        assert_eq!(euler.adjoint().adjoint(), euler);
    }
    // The stages of a composition, backwards, each its adjoint.
    let one = Composition::of(
        [
            (SymplecticEuler::KickDrift, Weight(0.25, 0.0)),
            (SymplecticEuler::DriftKick, Weight(0.75, 0.0)),
        ],
        1,
        "uneven",
    );
    assert_eq!(one.adjoint().adjoint(), one);
    assert_ne!(one.adjoint(), one);

    let system = Hand(DoublePendulum);
    let begin = start::<f64, _>(&system, &[0.9, -0.4], &[0.3, 0.2]);
    let h = 0.01;
    let plain = after(&system, RungeKutta4, &begin, h, 1);
    let twice = after(&system, Adjoint(Adjoint(RungeKutta4)), &begin, h, 1);
    assert!(difference(&plain, &twice) <= 1e-15);
    assert_eq!(RungeKutta4.adjoint().adjoint(), RungeKutta4);
    // (Φ₋ₕ)⁻¹ undoes Φ₋ₕ; Φₕ does not.
    let back = after(&system, RungeKutta4, &begin, -h, 1);
    let undone = after(&system, Adjoint(RungeKutta4), &back, h, 1);
    assert!(difference(&undone, &begin) <= 1e-15);
    assert!(difference(&after(&system, RungeKutta4, &back, h, 1), &begin) > 1e-12);

    // Solved and in closed form.
    let system = Hand(HenonHeiles);
    let begin = start::<f64, _>(&system, &[0.1, -0.25], &[0.42, 0.1]);
    for euler in [SymplecticEuler::KickDrift, SymplecticEuler::DriftKick] {
        let solved = after(&system, Adjoint(euler), &begin, 0.1, 1);
        let closed = after(&system, euler.adjoint(), &begin, 0.1, 1);
        assert!(difference(&solved, &closed) <= 1e-15);
        assert!(difference(&after(&system, euler, &begin, 0.1, 1), &closed) > 1e-4);
    }
}

/// Symplectic Euler and its adjoint: where the middle pieces fuse, a step has the bits of Verlet's.
#[test]
fn euler_composed_with_its_adjoint_is_verlet() {
    let system = Hand(Pumped);
    let mut state = start::<f64, _>(&system, &[1.1], &[0.7]);
    let (mut rounded, mut h) = (0, 0.1);
    for _ in 0..200 {
        let verlet = after(&system, StormerVerlet::KickDriftKick, &state, h, 1);
        let composed = Composition::with_adjoint(SymplecticEuler::KickDrift);
        assert_eq!(after(&system, composed, &state, h, 1), verlet);
        // Here the two kicks of half the duration do not: the same to rounding.
        let other = Composition::with_adjoint(SymplecticEuler::DriftKick);
        let other = after(&system, other, &state, h, 1);
        let drift_first = after(&system, StormerVerlet::DriftKickDrift, &state, h, 1);
        assert!(difference(&other, &drift_first) <= 4.0 * f64::EPSILON);
        rounded += usize::from(other != drift_first);
        (state, h) = (verlet, -0.97 * h);
    }
    assert!(rounded > 0);
}

/// If a stage closes with the piece the next one opens with, both are one, across steps too.
#[test]
fn compositions_fuse() {
    use crate::common::systems::counting;
    let count = |n: u64| {
        counting::reset();
        let system = Hand(counting::Counted);
        let begin = start::<f64, _>(&system, &[1.1], &[0.7]);
        let scheme = Composition::yoshida(StormerVerlet::KickDriftKick);
        after(&system, scheme, &begin, 0.01, n);
        counting::calls()
    };
    // The start is asked for its gradient; one kick opens the first step, one closes the copy that is seen.
    let ((asked, of_start), (kicks, drifts)) = (count(0), count(100));
    assert_eq!((asked, of_start), (1, 1));
    assert_eq!((kicks - asked, drifts - of_start), (3 * 100 + 1, 3 * 100));
}

/// A composition of Verlet and the table of Yoshida's are one scheme, rounded differently.
#[test]
fn the_time_of_every_stage_is_its_own() {
    let system = Hand(Pumped);
    let begin = start::<f64, _>(&system, &[1.1], &[0.7]);
    let strang = after(&system, Composition::yoshida(Strang), &begin, 0.05, 200);
    let verlet = Composition::yoshida(StormerVerlet::KickDriftKick);
    assert_eq!(after(&system, verlet, &begin, 0.05, 200), strang);
}
