//! The paper's schemes on the paper's systems, against values found twice by independent
//! programs, and what the book says is wrong in the paper, number by number. What the paper
//! prints depends on a run length and a zero of V it does not give.

// Check values stand as they were computed, with more digits than a double holds.
#![allow(clippy::excessive_precision)]

use crate::common::reference::{difference, jacobi, solution};
use crate::common::systems::*;
use crate::common::{assert_digits, state};
use hamiltonian::VectorOf;
use hamiltonian::prelude::*;
use hamiltonian::private::SVector;
use hamiltonian::schemes::{
    ConsecutiveSubTrajectories, IntersectingSubTrajectories, Pihajoki, SecondPoint,
};
use hamiltonian::{DoubleDouble, Real, Scheme, Separable, Unforced, Vector};
use std::f64::consts::FRAC_PI_4;

type One = SVector<f64, 1>;

/// The paper's starts.
fn on_pendulum() -> State<One> {
    State::new([FRAC_PI_4], [0.0])
}
fn on_paper34() -> State<One> {
    State::new([-3.0], [0.0])
}

/// That the book says so.
#[track_caller]
fn book_says(claim: &str) {
    let words: Vec<_> = include_str!("../book/src/paper.md")
        .split_whitespace()
        .collect();
    let text = words.join(" ");
    assert!(text.contains(claim), "the book does not say: {claim}");
}

/// max |ΔH/H₀| over every step up to `t`.
fn drift<S, M>(system: &S, scheme: M, start: State<One>, step: f64, t: f64) -> f64
where
    S: System<Shape = SVector<(), 1>>,
    M: Scheme<S>,
{
    let run = Integrator::new(system, scheme, start, step).unwrap();
    let mut run = run.observe(EnergyDrift::new());
    run.advance_to(t).unwrap();
    run.observer().max_relative()
}

#[test]
fn drift_of_29_on_the_pendulum() {
    let scheme = Pihajoki::CoordinateFirst;
    // The largest error comes once a period: T ≥ 10 does not change it.
    for t in [10.0, 20.0, 100.0] {
        let system = PendulumFromBottom::default();
        let from_bottom = drift(&system, scheme, on_pendulum(), 1e-3, t);
        assert_digits("V = mgl(1 - cos q)", from_bottom, 2.213e-7, 4);
        let from_pivot = drift(&Pendulum::default(), scheme, on_pendulum(), 1e-3, t);
        assert_digits("V = -mgl cos q", from_pivot, 9.17e-8, 3);
    }
}

/// (29) does not hold on (34): the copies part.
#[test]
fn copies_of_29_part_on_34() {
    book_says("at h = 1e-3 by 7e-5, 2.5e-3, 9.6e-2 and 2.7 at t = 1, 2, 3 and 4");
    book_says("max |ΔH/H₀| is 0.0024 %, 0.13 %, 6 % and 158 %");
    let system = Paper34::default();
    let run = Integrator::new(&system, Pihajoki::default(), on_paper34(), 1e-3).unwrap();
    let mut run = run.observe(EnergyDrift::new());
    for (t, distance, digits, drift, drift_digits) in [
        (1.0, 7e-5, 1, 2.4e-5, 2),
        (2.0, 2.5e-3, 2, 1.3e-3, 2),
        (3.0, 9.6e-2, 2, 6e-2, 1),
        (4.0, 2.7, 2, 1.58, 3),
    ] {
        run.advance_to(t).unwrap();
        assert_digits("copy distance", run.copy_distance(), distance, digits);
        let largest = run.observer().max_relative();
        assert_digits("max |dH/H0|", largest, drift, drift_digits);
    }
    run.advance_to(10.0).unwrap();
    assert_digits("max |dH/H0|", run.observer().max_relative(), 4.36, 3);
}

/// (33) with a half-step Euler start is (29): its points are the copy (q̃, p).
#[test]
fn scheme_33_with_half_euler_start_is_29() {
    book_says("equals the copy (q̃, p) of (29) to 1e-12 over 2000 steps");
    let system = Paper34::default();
    let scheme = IntersectingSubTrajectories::default().with_second_point(SecondPoint::HalfEuler);
    let mut intersecting = Integrator::new(&system, scheme, on_paper34(), 1e-3).unwrap();
    let mut pihajoki = Integrator::new(&system, Pihajoki::default(), on_paper34(), 1e-3).unwrap();
    let mut worst = [0.0_f64; 2];
    for _ in 0..2000 {
        intersecting.advance(1).unwrap();
        pihajoki.advance(1).unwrap();
        let (point, seen) = (intersecting.state(), pihajoki.state());
        let dp = (point.p[0] - seen.p[0]).abs();
        let to_copy = (point.q[0] - pihajoki.copy().q[0]).abs();
        let to_seen = (point.q[0] - seen.q[0]).abs();
        worst = [worst[0].max(dp).max(to_copy), worst[1].max(dp).max(to_seen)];
    }
    assert!(worst[0] <= 1e-12, "(33) against the copy: {:e}", worst[0]);
    // Against (q, p) it differs by the motion of the copies.
    assert_digits("(33) against (q, p)", worst[1], 2.5e-3, 2);
}

/// On separable systems (29) is drift–kick–drift and (30) kick–drift–kick, bit for bit.
#[test]
fn pihajoki_on_separable_systems_is_stormer_verlet() {
    book_says("(29) and (30) coincide with Störmer–Verlet bit for bit");
    fn same<S: Separable + Unforced>(system: &S, q: &[f64], p: &[f64], h: f64) {
        let numbers = |v: &[f64]| v.to_vec();
        let start = state(system, 0.0, numbers(q), numbers(p));
        let (first, second) = (Pihajoki::CoordinateFirst, Pihajoki::MomentumFirst);
        coincide(system, first, StormerVerlet::DriftKickDrift, &start, h);
        coincide(system, second, StormerVerlet::KickDriftKick, &start, h);
    }
    fn coincide<S: Separable + Unforced, const KICK_FIRST: bool>(
        system: &S,
        copies: Pihajoki,
        alone: StormerVerlet<KICK_FIRST>,
        start: &StateOf<S>,
        h: f64,
    ) {
        let mut copies = Integrator::new(system, copies, start.clone(), h).unwrap();
        let mut alone = Integrator::new(system, alone, start.clone(), h).unwrap();
        for _ in 0..500 {
            let (a, b) = (copies.advance(7).unwrap(), alone.advance(7).unwrap());
            let bits = |v: &VectorOf<S>| v.components().map(f64::to_bits).collect::<Vec<_>>();
            assert_eq!(
                (bits(&a.q), bits(&a.p)),
                (bits(&b.q), bits(&b.p)),
                "{}",
                system.description().name
            );
        }
    }
    same(&Pendulum::default(), &[FRAC_PI_4], &[0.0], 1e-2);
    same(&PendulumFromBottom::default(), &[FRAC_PI_4], &[0.0], 1e-2);
    same(&Relativistic::default(), &[0.9], &[0.4], 1e-2);
    same(&HenonHeiles::default(), &[0.1, -0.25], &[0.42, 0.0], 0.05);
}

/// The drift of (33) on the pendulum with h = 10⁻³ from this second point.
fn drift_of_33(second: SecondPoint, t: f64) -> f64 {
    let scheme = IntersectingSubTrajectories::default().with_second_point(second);
    drift(&Pendulum::default(), scheme, on_pendulum(), 1e-3, t)
}

/// The paper's start makes the large oscillation of its figure 1, not its schemes.
#[test]
fn starts_of_33_on_the_pendulum() {
    book_says("to t = 50 falls from 1.98e-2 % to 2.2e-5 %");
    let equal = drift_of_33(SecondPoint::Equal, 50.0);
    assert_digits("equal, T = 50", equal, 1.977e-4, 4);
    assert_digits("equal, T = 50, book", equal, 1.98e-4, 3);
    let half_euler = drift_of_33(SecondPoint::HalfEuler, 50.0);
    assert_digits("half-Euler, T = 50", half_euler, 2.19e-7, 3);
    assert_digits("half-Euler, T = 50, book", half_euler, 2.2e-7, 2);
    assert_digits("ratio, T = 50", equal / half_euler, 901.0, 3);
    // The error of the half-Euler start grows linearly.
    let later = [SecondPoint::Equal, SecondPoint::HalfEuler].map(|second| drift_of_33(second, 1e3));
    assert_digits("ratio, T = 1e3", later[0] / later[1], 56.0, 2);
    let second = drift_of_33(SecondPoint::SecondOrder, 50.0);
    assert_digits("second order", second, 4.96e-9, 3);
    assert_digits("ratio", equal / second, 40_000.0, 1);
}

/// The same to t = 10⁴.
#[test]
#[ignore = "many steps: `.ci/run` makes them"]
fn starts_of_33_on_the_pendulum_for_long() {
    book_says(
        "The default start, an explicit midpoint step backwards, gives 5.0e-7 % up to t = 10⁴",
    );
    let at = |second| drift_of_33(second, 1e4);
    let [equal, half_euler, second] = [
        SecondPoint::Equal,
        SecondPoint::HalfEuler,
        SecondPoint::SecondOrder,
    ]
    .map(at);
    assert_digits("ratio, T = 1e4", equal / half_euler, 6.0, 1);
    assert_digits("second order, T = 1e4", second, 4.96e-9, 3);
    assert_digits("second order, T = 1e4, book", second, 5.0e-9, 2);
    assert_digits(
        "ratio of second order, T = 1e4",
        equal / second,
        40_000.0,
        1,
    );
}

/// (26) with half the step is (33), and its true time is what the state says.
#[test]
fn scheme_26_advances_two_steps() {
    book_says("A step of (26) advances the time by 2h");
    let system = Pendulum::default();
    let scheme = ConsecutiveSubTrajectories::default();
    let mut consecutive = Integrator::new(&system, scheme, on_pendulum(), 5e-4).unwrap();
    let scheme = IntersectingSubTrajectories::default();
    let mut intersecting = Integrator::new(&system, scheme, on_pendulum(), 1e-3).unwrap();
    assert_eq!(consecutive.duration(), 1e-3);
    let ends = (consecutive.advance(1000), intersecting.advance(1000));
    assert_eq!(ends.0.unwrap(), ends.1.unwrap());
    assert_eq!(consecutive.time(), 1.0);
    // As the paper runs it, at the same Δt, one run of it is twice as long.
    let scheme = ConsecutiveSubTrajectories::default();
    let mut run = Integrator::new(&system, scheme, on_pendulum(), 1e-3).unwrap();
    assert_eq!(run.advance(1000).unwrap().t, 2.0);
}

#[test]
#[ignore = "many steps: `.ci/run` makes them"]
fn drift_of_implicit_midpoint_on_34() {
    let system = Paper34::default();
    let at = |h| {
        drift(
            &system,
            ImplicitMidpoint::default(),
            on_paper34(),
            h,
            1000.0,
        )
    };
    assert_digits("h = 1e-3", at(1e-3), 1.17e-6, 3);
    assert_digits("h = 1e-2", at(1e-2), 1.17e-4, 3);
}

/// From (−3, 0), where H = 5, (34) is solved by q = −3 cn(√10 t | 0.9), p = q̇/(1 + q²).
#[test]
fn exact_solution_of_34() {
    fn exact<T: Real>(t: T) -> [T; 2] {
        let number = |x| T::constant(x, 0.0);
        let (root, nine) = (number(10.0).sqrt(), number(9.0));
        let [sn, cn, dn] = jacobi(root * t, nine / number(10.0));
        let q = -number(3.0) * cn;
        [q, number(3.0) * root * sn * dn / (T::one() + q * q)]
    }
    let system = Paper34::default();
    let numbers = |values: [f64; 2]| values.map(DoubleDouble::from);
    let [q, p] = numbers([-3.0, 0.0]);
    let mut at = state(&system, DoubleDouble::zero(), [q], [p]);
    assert_eq!(system.energy(&at).to_f64(), 5.0);
    for k in 1..=20 {
        at = solution(&system, &at, DoubleDouble::from(0.5 * f64::from(k)));
        let [q, p] = exact(at.t);
        let end = state(&system, at.t, [q], [p]);
        // κ = 8; the angles of cn pass 30, and their rounding is multiplied as much.
        let error = difference(&at, &end);
        assert!(error <= 1e-26, "t = {}: {error:e}", at.t);
    }
    // Schemes come down on it as their order says, in f64 too.
    let error = |steps: u32| {
        let h = 10.0 / f64::from(steps);
        let mut run = Integrator::new(&system, RungeKutta4, on_paper34(), h).unwrap();
        let [q, p] = exact(10.0);
        difference(
            run.advance(steps.into()).unwrap(),
            &State::new([q], [p]).at(10.0),
        )
    };
    let ratio = error(2500) / error(5000);
    assert!((ratio.log2() - 4.0).abs() <= 0.1, "{ratio}");
}
