//! Runs: blocks, replay, time, direction, observers, errors.

use crate::common::systems::*;
use crate::common::{difference, start};
use hamiltonian_core::prelude::*;
use hamiltonian_core::schemes::walk::{
    Visitor, visit_any, visit_separable, visit_split, visit_unforced,
};
use hamiltonian_core::{Real, Scheme, Vector, observers::watch, private::SVector};

fn oscillating() -> State<SVector<f64, 2>> {
    State::new([0.1, -0.25], [0.42, 0.1])
}

/// Cuts and observers leave every bit as it is.
struct SameBits<S>(S);

impl<S: System<f64>> Visitor<f64, S> for SameBits<S> {
    fn visit<M: Scheme<f64, S>>(&mut self, scheme: M) {
        let n = <S as System<f64>>::zeros(&self.0).len();
        let (q, p) = ([0.1, -0.25], [0.42, 0.1]);
        let start = start::<f64, S>(&self.0, &q[..n], &p[..n]);
        let new = || Integrator::new(&self.0, scheme.clone(), start.clone(), 0.01).unwrap();
        let mut whole = new();
        let whole = whole.advance(5000).unwrap();
        let name = scheme.entry().name;
        let mut cut = new();
        for n in [1, 2, 1021, 3, 0, 1024, 2949] {
            cut.advance(n).unwrap();
        }
        assert_eq!(cut.state(), whole, "{name}, cut");
        let mut seen = 0;
        let mut watched = new().observe((
            EnergyDrift::new(),
            every(7, watch(|_: &hamiltonian_core::View<'_, f64, S>| seen += 1)),
        ));
        watched
            .advance_to(start.t + watched.interval() * 5000.0)
            .unwrap();
        assert_eq!(watched.state(), whole, "{name}, watched");
        drop(watched);
        assert_eq!(seen, 1 + 5000 / 7, "{name}");
        let mut iterated = new();
        let last = iterated.states(40).nth(124).unwrap().unwrap();
        assert_eq!(&last, whole, "{name}, iterated");
    }
}

#[test]
fn bits_do_not_depend_on_cuts_or_observers() {
    let mut visitor = SameBits(Hand(Pumped));
    visit_any::<f64, _>(&mut visitor);
    visit_unforced::<f64, _>(&mut visitor);
    visit_separable::<f64, _>(&mut visitor);
    visit_split::<f64, _>(&mut visitor);
    visit_any::<f64, _>(&mut SameBits(Hand(DoublePendulum)));
    visit_unforced::<f64, _>(&mut SameBits(Hand(DoublePendulum)));
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
    fn there_and_back<M: Scheme<f64, Hand<HenonHeiles, 2>>>(scheme: M) {
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
    assert_eq!(
        run.advance_to(1.3).unwrap_err(),
        Error::OffGrid {
            clock: "t",
            target: 1.3,
            before: 1.0,
            after: 1.5
        }
    );
    assert_eq!(
        run.advance_to(0.5).unwrap_err(),
        Error::Behind {
            clock: "t",
            target: 0.5,
            now: 1.0,
        }
    );
    assert!(matches!(run.advance_to(-3.0), Err(Error::Behind { .. })));
    assert!(matches!(
        run.advance_to(f64::NAN),
        Err(Error::Unreachable { .. })
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
        assert!(matches!(error, Error::Step { step: found } if found.to_bits() == step.to_bits()));
    }
    let start = State::new([f64::INFINITY, 0.0], [0.0, 1.0]).at(2.0);
    assert_eq!(
        Integrator::new(&system, RungeKutta4, start, 0.1).unwrap_err(),
        Error::Start {
            clock: "t",
            time: 2.0,
            q: vec![f64::INFINITY, 0.0],
            p: vec![0.0, 1.0]
        }
    );
    let chain = Chain { n: 4 };
    let start = State {
        t: 0.0,
        q: vec![0.0; 4].into(),
        p: vec![0.0; 3].into(),
    };
    assert_eq!(
        Integrator::new(&chain, RungeKutta4, start, 0.1).unwrap_err(),
        Error::Shape {
            name: "p",
            expected: 4,
            found: 3
        }
    );
}

/// Escape from Hénon–Heiles overflows; the step that does is found wherever the block lies.
#[test]
fn the_first_bad_step_is_found() {
    struct FirstBad;
    impl Visitor<f64, Hand<HenonHeiles, 2>> for FirstBad {
        fn visit<M: Scheme<f64, Hand<HenonHeiles, 2>>>(&mut self, scheme: M) {
            let start = State::new([0.3, 1.2], [0.4, 0.6]);
            let new = || {
                Integrator::new(&Hand(HenonHeiles), scheme.clone(), start.clone(), 0.01).unwrap()
            };
            let mut single = new();
            let expected = (0..100_000)
                .find_map(|_| single.advance(1).err())
                .expect("it escapes");
            let entry = scheme.entry();
            match &expected {
                Error::NotFinite {
                    step, time, q, p, ..
                } => {
                    assert_eq!(*step, single.steps() + 1);
                    assert_eq!(*time, *step as f64 * single.interval());
                    assert!(q.iter().chain(p).any(|x| !x.is_finite()), "{}", entry.name);
                }
                Error::Solve {
                    step,
                    time,
                    residual,
                    iterations,
                    ..
                } => {
                    let implicit = [
                        "ImplicitMidpoint",
                        "Gauss",
                        "DiscreteGradient",
                        "Semiexplicit",
                    ];
                    assert!(implicit.contains(&entry.name), "{}", entry.name);
                    assert_eq!(*step, single.steps() + 1);
                    assert_eq!(*time, single.time());
                    assert!(
                        // The limits of the semiexplicit method and of the others.
                        !residual.is_finite() || matches!(*iterations, 50 | 100),
                        "{residual} {iterations}"
                    );
                }
                other => panic!("{other:?}"),
            }
            assert!(
                single
                    .state()
                    .q
                    .iter()
                    .chain(&single.state().p)
                    .all(|x| x.is_finite())
            );
            let same = |a: &Error, b: &Error| assert_eq!(format!("{a:?}"), format!("{b:?}"));
            // In one call, across blocks, observed, iterated: the same error, the same last state.
            let mut whole = new();
            same(&whole.advance(1_000_000).unwrap_err(), &expected);
            assert_eq!(whole.state(), single.state());
            assert_eq!(whole.steps(), single.steps());
            let mut shifted = new();
            shifted.advance(13).unwrap();
            same(&shifted.advance(1_000_000).unwrap_err(), &expected);
            let mut watched = new().observe(every(
                3,
                watch(
                    |view: &hamiltonian_core::View<'_, f64, Hand<HenonHeiles, 2>>| {
                        assert!(view.state.q.is_finite() && view.state.p.is_finite());
                    },
                ),
            ));
            same(&watched.advance(1_000_000).unwrap_err(), &expected);
            let mut iterated = new();
            let items: Vec<_> = iterated.states(5).collect();
            same(items.last().unwrap().as_ref().unwrap_err(), &expected);
            assert!(items[..items.len() - 1].iter().all(Result::is_ok));
            // Asked again, the run says the same again.
            same(&whole.advance(1).unwrap_err(), &expected);
        }
    }
    visit_any::<f64, _>(&mut FirstBad);
    visit_unforced::<f64, _>(&mut FirstBad);
    visit_separable::<f64, _>(&mut FirstBad);
    visit_split::<f64, _>(&mut FirstBad);
}

/// A step too long for the iteration is an error with its residual.
#[test]
fn a_failed_solve_is_reported() {
    let scheme = ImplicitMidpoint { max_iterations: 9 };
    let start = State::new([1.0], [0.3]);
    let mut run = Integrator::new(&Hand(Paper34), scheme, start.clone(), 0.5).unwrap();
    match run.advance(3).unwrap_err() {
        Error::Solve {
            step: 1,
            time: 0.0,
            residual,
            iterations: 9,
            ..
        } => assert!(residual > f64::EPSILON),
        other => panic!("{other:?}"),
    }
    assert_eq!(run.state(), &start);
}

/// So many iterations of the fixed point, and as many of Newton's method, are not enough for rounding.
#[test]
fn limits_of_iterations_are_kept() {
    fn stopped(scheme: impl Scheme<f64, Hand<Paper34, 1>>, most: u32) {
        let start = State::new([1.0], [0.3]);
        let mut run = Integrator::new(&Hand(Paper34), scheme, start, 0.25).unwrap();
        match run.advance(1).unwrap_err() {
            Error::Solve { iterations, .. } => assert_eq!(iterations, most),
            other => panic!("{other:?}"),
        }
    }
    for most in 1..=3 {
        stopped(Gauss::<2>::default().at_most(most), most);
        stopped(Variational::<2, 2>::gauss().at_most(most), most);
        stopped(Variational::<2, 3>::lobatto().at_most(most), most);
        stopped(Variational::<2, 2>::lobatto().at_most(most), most);
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
