//! Runs: blocks, replay, time, direction, observers, errors.

use crate::common::difference;
use crate::common::systems::*;
use hamiltonian_core::errors::{InputError, StartError, StepError, TimeError};
use hamiltonian_core::prelude::*;
use hamiltonian_core::schemes::Variational;
use hamiltonian_core::{Real, Scheme, private::SVector};

fn oscillating() -> State<SVector<f64, 2>> {
    State::new([0.1, -0.25], [0.42, 0.1])
}

/// Time is t₀ + k·h.
#[test]
fn time_is_not_summed() {
    let run = Integrator::new(
        &Hand(HenonHeiles),
        StormerVerlet::default(),
        oscillating().at(0.7),
        0.1,
    );
    let mut run = run.unwrap();
    for k in 1..=1000 {
        run.advance(1).unwrap();
        assert_eq!((run.steps(), run.time()), (k, 0.7 + k as f64 * 0.1));
    }
}

/// Forwards and back: symmetric schemes return to rounding.
#[test]
fn negative_steps_integrate_backwards() {
    fn there_and_back<M: Scheme<Hand<HenonHeiles, 2>>>(scheme: M) {
        let system = Hand(HenonHeiles);
        let mut there = Integrator::new(&system, scheme.clone(), oscillating(), 0.05).unwrap();
        let end = there.advance_to(50.0).unwrap().clone();
        let mut back = Integrator::new(&system, scheme, end, -0.05).unwrap();
        let end = back.advance_to(0.0).unwrap();
        let error = difference(end, &oscillating());
        // A regular orbit: 2000 steps of a few roundings each, growing linearly.
        assert!(error <= 1e-11, "{error:e}");
        assert!(end.t.abs() <= 50.0 * f64::EPSILON);
    }
    there_and_back(StormerVerlet::KickDriftKick);
    there_and_back(StormerVerlet::DriftKickDrift);
    there_and_back(ImplicitMidpoint::default());
}

#[test]
fn advance_to_takes_whole_steps_or_none() {
    let new = |h| {
        Integrator::new(
            &Hand(HenonHeiles),
            StormerVerlet::default(),
            oscillating(),
            h,
        )
    };
    // Decimal steps and times meet although neither is exact.
    for (h, t, steps) in [
        (0.1, 0.3, 3),
        (1e-3, 10.0, 10_000),
        (-0.1, -0.7, 7),
        (0.05, 0.0, 0),
    ] {
        let mut run = new(h).unwrap();
        run.advance_to(t).unwrap();
        assert_eq!(run.steps(), steps);
    }
    let mut run = new(0.5).unwrap();
    run.advance_to(1.0).unwrap();
    // In between, behind, NaN, beyond all numbers: refused, and nothing moves.
    assert!(matches!(
        run.advance_to(1.3),
        Err(Error::Time(TimeError::OffGrid {
            target: 1.3,
            before: 1.0,
            after: 1.5,
            ..
        }))
    ));
    assert!(matches!(
        run.advance_to(0.5),
        Err(Error::Time(TimeError::Behind {
            target: 0.5,
            now: 1.0,
            ..
        }))
    ));
    assert!(matches!(
        run.advance_to(-3.0),
        Err(Error::Time(TimeError::Behind { .. }))
    ));
    assert!(matches!(
        run.advance_to(f64::NAN),
        Err(Error::Time(TimeError::Unreachable { .. }))
    ));
    let beyond = run.advance_to(f64::INFINITY).unwrap_err();
    assert_eq!(
        beyond.to_string(),
        "t = inf cannot be reached: give a finite time, less than 2^53 steps ahead"
    );
    assert_eq!((run.steps(), run.time()), (2, 1.0));
    // Here already.
    run.advance_to(1.0).unwrap();
    assert_eq!(run.steps(), 2);
}

#[test]
fn bad_starts_and_steps_are_refused() {
    let system = Hand(HenonHeiles);
    for step in [0.0, -0.0, f64::NAN, f64::INFINITY] {
        let error = Integrator::new(&system, RungeKutta4, oscillating(), step).unwrap_err();
        assert!(
            matches!(error, Error::Start(StartError::Step { value: found, .. }) if found.to_bits() == step.to_bits())
        );
    }
    let start = State::new([f64::INFINITY, 0.0], [0.0, 1.0]).at(2.0);
    match Integrator::new(&system, RungeKutta4, start, 0.1).unwrap_err() {
        Error::Start(StartError::NotFinite {
            clock, time, q, p, ..
        }) => {
            assert_eq!((&*clock, time), ("t", 2.0));
            assert_eq!((&*q, &*p), (&[f64::INFINITY, 0.0][..], &[0.0, 1.0][..]));
        }
        error => panic!("{error}"),
    }
    let chain = Chain { n: 4 };
    let start = State::new(vec![0.0; 4], vec![0.0; 3]);
    match Integrator::new(&chain, RungeKutta4, start, 0.1).unwrap_err() {
        Error::Input(InputError::Shape {
            name,
            expected,
            found,
            ..
        }) => {
            assert_eq!((&*name, expected, found), ("p", 4, 3));
        }
        error => panic!("{error}"),
    }
}

/// A step too long for the iteration is an error with its residual.
#[test]
fn a_failed_solve_is_reported() {
    let scheme = ImplicitMidpoint::default().with_max_iterations(9);
    let start = State::new([1.0], [0.3]);
    let mut run = Integrator::new(&Hand(Paper34), scheme, start.clone(), 0.5).unwrap();
    match run.advance(3).unwrap_err() {
        Error::Step(StepError::Unsolved {
            step: 1,
            time: 0.0,
            residual,
            iterations: 9,
            ..
        }) => assert!(residual > f64::EPSILON),
        other => panic!("{other:?}"),
    }
    assert_eq!(run.state(), &start);
}

/// So many iterations of the fixed point, and as many of Newton's method, are not enough for rounding.
#[test]
fn limits_of_iterations_are_kept() {
    fn stopped(scheme: impl Scheme<Hand<Paper34, 1>>, most: u32) {
        let start = State::new([1.0], [0.3]);
        let mut run = Integrator::new(&Hand(Paper34), scheme, start, 0.25).unwrap();
        match run.advance(1).unwrap_err() {
            Error::Step(StepError::Unsolved { iterations, .. }) => assert_eq!(iterations, most),
            other => panic!("{other:?}"),
        }
    }
    for most in 1..=3 {
        stopped(Gauss::<2>::default().with_max_iterations(most), most);
        stopped(Variational::<2, 2>::gauss().with_max_iterations(most), most);
        stopped(
            Variational::<2, 3>::lobatto().with_max_iterations(most),
            most,
        );
        stopped(
            Variational::<2, 2>::lobatto().with_max_iterations(most),
            most,
        );
    }
    // The control.
    let start = State::new([1.0], [0.3]);
    let mut run = Integrator::new(&Hand(Paper34), Gauss::<2>::default(), start, 0.25).unwrap();
    run.advance(1).unwrap();
}

/// The schemes run on other scalars.
#[test]
fn any_scalar() {
    fn run<T: Real>() -> f64 {
        let start = State::over([T::constant(0.7, 0.0)], [T::zero()]);
        let h = T::constant(0.0625, 0.0);
        let mut run =
            Integrator::new(&pendulum(false), StormerVerlet::default(), start, h).unwrap();
        run.advance(64).unwrap().q[0].to_f64()
    }
    let double = run::<f64>();
    // 64 steps of single precision.
    assert!((run::<f32>() - double).abs() <= 64.0 * f64::from(f32::EPSILON));
    assert!((run::<DoubleDouble>() - double).abs() <= 64.0 * f64::EPSILON);
    assert_eq!(run::<Dual<f64>>(), double);
}
