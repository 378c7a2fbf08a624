//! The paper's schemes on the paper's systems, against values found twice by independent
//! programs. What the paper prints depends on a run length and a zero of V it does not give.

// Check values stand as they were computed, with more digits than a double holds.
#![allow(clippy::excessive_precision)]

mod common;

use common::assert_digits;
use common::reference::{difference, solution};
use common::systems::*;
use hamiltonian_core::prelude::*;
use hamiltonian_core::{Scheme, private::SVector};
use std::f64::consts::FRAC_PI_4;

type One = SVector<f64, 1>;

/// The paper's starts.
fn on_pendulum() -> State<One> {
    State::new([FRAC_PI_4], [0.0])
}
fn on_paper34() -> State<One> {
    State::new([-3.0], [0.0])
}

/// max |ΔH/H₀| over every step up to `t`.
fn drift<S, M>(system: &S, scheme: M, start: State<One>, step: f64, t: f64) -> f64
where
    S: System<f64, Vector = One>,
    M: Scheme<f64, S>,
{
    let mut run = Integrator::new(system, scheme, start, step)
        .unwrap()
        .observe(EnergyDrift::new());
    run.advance_to(t).unwrap();
    run.observer().max_relative()
}

#[test]
fn drift_of_29_on_the_pendulum() {
    let from_bottom = drift(
        &pendulum(true),
        Pihajoki::default(),
        on_pendulum(),
        1e-3,
        20.0,
    );
    assert_digits("V = mgl(1 - cos q)", from_bottom, 2.213e-7, 4);
    let from_pivot = drift(
        &pendulum(false),
        Pihajoki::default(),
        on_pendulum(),
        1e-3,
        20.0,
    );
    assert_digits("V = -mgl cos q", from_pivot, 9.17e-8, 3);
}

#[test]
fn copies_of_29_part_on_34() {
    let mut run = Integrator::new(&Hand(Paper34), Pihajoki::default(), on_paper34(), 1e-3)
        .unwrap()
        .observe(EnergyDrift::new());
    for (t, distance, digits, drift, drift_digits) in [
        (1.0, 7e-5, 1, 2.4e-5, 2),
        (2.0, 2.5e-3, 2, 1.3e-3, 2),
        (3.0, 9.6e-2, 2, 6e-2, 1),
        (4.0, 2.7, 2, 1.58, 3),
    ] {
        run.advance_to(t).unwrap();
        assert_digits("copy distance", run.copy_distance(), distance, digits);
        assert_digits(
            "max |dH/H0|",
            run.observer().max_relative(),
            drift,
            drift_digits,
        );
    }
    run.advance_to(10.0).unwrap();
    assert_digits("max |dH/H0|", run.observer().max_relative(), 4.36, 3);
}

/// (33) with a half-step Euler start is (29): its points are the copy (q̃, p).
#[test]
fn scheme_33_with_half_euler_start_is_29() {
    let system = Hand(Paper34);
    let scheme = IntersectingSubTrajectories {
        start: Start::HalfEuler,
    };
    let mut intersecting = Integrator::new(&system, scheme, on_paper34(), 1e-3).unwrap();
    let mut pihajoki = Integrator::new(&system, Pihajoki::default(), on_paper34(), 1e-3).unwrap();
    let mut worst = [0.0_f64; 2];
    for _ in 0..2000 {
        intersecting.advance(1).unwrap();
        pihajoki.advance(1).unwrap();
        let (point, seen) = (intersecting.state(), pihajoki.state());
        let dp = (point.p[0] - seen.p[0]).abs();
        worst[0] = worst[0]
            .max(dp)
            .max((point.q[0] - pihajoki.copy().q[0]).abs());
        worst[1] = worst[1].max(dp).max((point.q[0] - seen.q[0]).abs());
    }
    assert!(worst[0] <= 1e-12, "(33) against the copy: {:e}", worst[0]);
    // Against (q, p) it differs by what the copies do.
    assert_digits("(33) against (q, p)", worst[1], 2.5e-3, 2);
}

/// On separable systems (29) is drift–kick–drift and (30) kick–drift–kick, bit for bit.
#[test]
fn pihajoki_on_separable_systems_is_stormer_verlet() {
    for (copies, alone) in [
        (Pihajoki::CoordinateFirst, StormerVerlet::DriftKickDrift),
        (Pihajoki::MomentumFirst, StormerVerlet::KickDriftKick),
    ] {
        let system = pendulum(false);
        let mut copies = Integrator::new(&system, copies, on_pendulum(), 1e-2).unwrap();
        let mut alone = Integrator::new(&system, alone, on_pendulum(), 1e-2).unwrap();
        for _ in 0..500 {
            assert_eq!(copies.advance(7).unwrap(), alone.advance(7).unwrap());
        }
        let system = Hand(HenonHeiles);
        let start = State::new([0.1, -0.25], [0.42, 0.0]);
        let (copies, alone) = (copies.entry(), alone.entry());
        assert_eq!((copies.order, alone.order), (2, 2));
        let mut copies =
            Integrator::new(&system, Pihajoki::default(), start.clone(), 0.05).unwrap();
        let mut alone =
            Integrator::new(&system, StormerVerlet::DriftKickDrift, start, 0.05).unwrap();
        assert_eq!(copies.advance(3000).unwrap(), alone.advance(3000).unwrap());
    }
}

/// The paper's start makes the large oscillation of its figure 1, not its schemes.
#[test]
fn starts_of_33_on_the_pendulum() {
    let at = |start, t| {
        drift(
            &pendulum(false),
            IntersectingSubTrajectories { start },
            on_pendulum(),
            1e-3,
            t,
        )
    };
    let equal = at(Start::Equal, 50.0);
    assert_digits("equal, T = 50", equal, 1.977e-4, 4);
    let half_euler = at(Start::HalfEuler, 50.0);
    assert_digits("half-Euler, T = 50", half_euler, 2.19e-7, 3);
    assert_digits("ratio, T = 50", equal / half_euler, 901.0, 3);
    // The error of the half-Euler start grows linearly.
    let ratio = |t| at(Start::Equal, t) / at(Start::HalfEuler, t);
    assert_digits("ratio, T = 1e3", ratio(1e3), 56.0, 2);
    assert_digits("ratio, T = 1e4", ratio(1e4), 6.0, 1);
    assert_digits(
        "second order, T = 50",
        at(Start::SecondOrder, 50.0),
        4.96e-9,
        3,
    );
    assert_digits(
        "second order, T = 1e4",
        at(Start::SecondOrder, 1e4),
        4.96e-9,
        3,
    );
}

/// (26) with half the step is (33), and its true time is what the state says.
#[test]
fn scheme_26_advances_two_steps() {
    let system = pendulum(false);
    let scheme = ConsecutiveSubTrajectories::default();
    let mut consecutive = Integrator::new(&system, scheme, on_pendulum(), 5e-4).unwrap();
    let scheme = IntersectingSubTrajectories::default();
    let mut intersecting = Integrator::new(&system, scheme, on_pendulum(), 1e-3).unwrap();
    assert_eq!(consecutive.interval(), 1e-3);
    assert_eq!(
        consecutive.advance(1000).unwrap(),
        intersecting.advance(1000).unwrap()
    );
    assert_eq!(consecutive.time(), 1.0);
}

#[test]
fn drift_of_implicit_midpoint_on_34() {
    let at = |h| {
        drift(
            &Hand(Paper34),
            ImplicitMidpoint::default(),
            on_paper34(),
            h,
            1000.0,
        )
    };
    assert_digits("h = 1e-3", at(1e-3), 1.17e-6, 3);
    assert_digits("h = 1e-2", at(1e-2), 1.17e-4, 3);
}

/// Systems 1, 2, 4 and 7 of the table of check values (quadruple precision), by the reference the
/// order tests use and, within its own error, by a scheme.
#[test]
fn check_values() {
    fn check<S: System<f64, Vector = V>, V: hamiltonian_core::Vector<Scalar = f64>>(
        system: &S,
        start: State<V>,
        end: State<V>,
        step: f64,
    ) {
        // κ·1e-16 with the κ of the table (62, 8, 15, 31), times the evaluations of a run.
        let found = solution(system, &start, end.t);
        let error = difference(&found, &end);
        assert!(error <= 1e-11, "{}: {error:e}", S::NAME);
        let mut coarse = Integrator::new(system, RungeKutta4, start.clone(), step).unwrap();
        let mut fine = Integrator::new(system, RungeKutta4, start, step / 2.0).unwrap();
        let coarse = difference(coarse.advance_to(end.t).unwrap(), &end);
        let fine = difference(fine.advance_to(end.t).unwrap(), &end);
        assert!(
            fine <= 1e-9 && fine < coarse,
            "{}: {coarse:e}, {fine:e}",
            S::NAME
        );
    }
    check(
        &pendulum(false),
        on_pendulum(),
        State::new([-0.781647728717349456], [7.20650538496944192]).at(10.0),
        2e-3,
    );
    check(
        &Hand(Paper34),
        on_paper34(),
        State::new([-2.40223831310082726], [0.690609507457253471]).at(10.0),
        1e-3,
    );
    check(
        &Hand(HenonHeiles),
        State::new(
            [0.0, 0.2587703282931232],
            [-0.2525875586263492, -0.2178423952983717],
        ),
        State::new(
            [-0.120505861737461384, -0.221927867217970471],
            [0.0494084540741289, -0.315610143448945754],
        )
        .at(100.0),
        4e-3,
    );
    check(
        &Hand(Driven { a: 0.1, omega: 1.0 }),
        State::new([1.0], [0.0]),
        State::new([0.675915315318476552], [0.919206393040409427]).at(50.0),
        4e-3,
    );
}

/// Periods: the exact ones bring the start back.
#[test]
fn periods() {
    let close = |error: f64, name: &str| assert!(error <= 1e-11, "{name}: {error:e}");
    let (system, start) = (pendulum(false), on_pendulum());
    close(
        difference(&solution(&system, &start, 6.597320339363502), &start),
        "pendulum",
    );
    let (system, start) = (Hand(Paper34), on_paper34());
    close(
        difference(&solution(&system, &start, 3.261057238358885321), &start),
        "(34)",
    );
}
