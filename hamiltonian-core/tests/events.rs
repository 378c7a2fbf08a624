//! Events that a run locates, and outputs at given times.

use crate::common::systems::*;
use core::f64::consts::{PI, TAU};
use core::ops::ControlFlow;
use hamiltonian_core::errors::TimeError;
use hamiltonian_core::prelude::*;
use hamiltonian_core::private::SVector;
use hamiltonian_core::schemes::Composition;
use hamiltonian_core::{DoubleDouble, Error, Scheme, View};

type Heiles = Hand<HenonHeiles, 2>;
type Plane = SVector<f64, 2>;

fn begin() -> State<Plane> {
    State::new([0.1, -0.25], [0.42, 0.1])
}

/// x = 0 rising, y = 0 both ways, and y at its extremes.
fn events() -> Events<Plane> {
    Events::new([
        Event::of("x", |state: &State<Plane>| state.q[0]).with_direction(1),
        Event::of("y", |state: &State<Plane>| state.q[1]),
        Event::of("turn", |state: &State<Plane>| state.p[1]).with_direction(-1),
    ])
}

/// The times of the roots have the order of the scheme, and the states are those of `state_at`.
#[test]
fn roots_have_the_order_of_the_scheme() {
    fn times<M: Scheme<Heiles>>(scheme: M, h: f64) -> Vec<f64> {
        let mut run = Integrator::new(&Hand(HenonHeiles), scheme, begin(), h)
            .unwrap()
            .observe(events());
        run.advance_to(20.0).unwrap();
        run.observer().states("x").map(|state| state.t).collect()
    }
    fn of_order<M: Scheme<Heiles>>(scheme: M, order: f64) {
        let name = scheme.entry().name;
        let [a, b, c] = [0.1, 0.05, 0.025].map(|h| times(scheme.clone(), h));
        let worst = |a: &[f64], b: &[f64]| {
            assert!(a.len() == b.len() && a.len() >= 2, "{name}");
            a.iter()
                .zip(b)
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f64::max)
        };
        let slope = (worst(&a, &b) / worst(&b, &c)).log2();
        assert!((slope - order).abs() < 0.3, "{name}: {slope}");
    }
    of_order(StormerVerlet::KickDriftKick, 2.0);
    of_order(ImplicitMidpoint::default(), 2.0);
    of_order(Composition::yoshida(StormerVerlet::DriftKickDrift), 4.0);
    of_order(BlanesMoan4, 4.0);
    of_order(RungeKutta4, 4.0);

    let scheme = BlanesMoan4;
    let mut run = Integrator::new(&Hand(HenonHeiles), scheme, begin(), 0.1)
        .unwrap()
        .observe(events());
    run.advance_to(20.0).unwrap();
    for found in run.observer().located() {
        let mut plain = Integrator::new(&Hand(HenonHeiles), scheme, begin(), 0.1).unwrap();
        let state = plain.advance_until(found.state.t).unwrap();
        for (a, b) in state
            .q
            .iter()
            .chain(&state.p)
            .zip(found.state.q.iter().chain(&found.state.p))
        {
            assert!((a - b).abs() < 1e-14);
        }
    }
}

/// A run in steps of 1/8 on which functions of time alone are watched.
fn clock(events: Events<Plane>) -> Run<Heiles, StormerVerlet, Events<Plane>> {
    let scheme = StormerVerlet::default();
    let run = Integrator::new(&Hand(HenonHeiles), scheme, begin(), 0.125).unwrap();
    run.observe(events)
}

fn at(name: &str, function: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Event<Plane> {
    Event::of(name, move |state: &State<Plane>| function(state.t))
}

fn times(events: &Events<Plane>) -> Vec<(usize, bool, f64)> {
    let located = events.located().iter();
    located
        .map(|found| (found.event, found.rising, found.state.t))
        .collect()
}

fn assert_times(events: &Events<Plane>, expected: &[(usize, bool, f64)]) {
    let found = times(events);
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert_eq!((found.0, found.1), (expected.0, expected.1), "{found:?}");
        assert!(
            (found.2 - expected.2).abs() < 1e-12,
            "{found:?} {expected:?}"
        );
    }
}

#[test]
fn several_events_in_a_step_come_in_the_order_of_time() {
    let mut run = clock(Events::new([
        at("c", |t| t - 1.08),
        at("a", |t| 1.01 - t),
        at("b", |t| t * t * t - 1.05 * 1.05 * 1.05),
        at("on the grid", |t| t - 1.125),
        at("rising", |t| 1.03 - t).with_direction(1),
    ]));
    run.advance(16).unwrap();
    let expected = [
        (1, false, 1.01),
        (2, true, 1.05),
        (0, true, 1.08),
        (3, true, 1.125),
    ];
    assert_times(run.observer(), &expected);
    assert_eq!(run.observer().count("b"), 1);
    assert_eq!(run.observer().count("rising"), 0);
}

#[test]
fn two_roots_within_a_step_are_found() {
    // 1.03 ± 0.01 lie in the step from 1 to 1.125, 0.06 ± 0.01 in the first.
    let mut run = clock(Events::new([
        at("twice", |t| (t - 1.03) * (t - 1.03) - 1e-4),
        at("below", |t| 1e-4 - (t - 0.06) * (t - 0.06)),
        at("not quite", |t| (t - 1.03) * (t - 1.03) + 1e-9),
    ]));
    run.advance(16).unwrap();
    let expected = [
        (1, true, 0.05),
        (1, false, 0.07),
        (0, false, 1.02),
        (0, true, 1.04),
    ];
    assert_times(run.observer(), &expected);
}

#[test]
fn starts_on_an_event_touches_and_poles_are_none() {
    let mut run = clock(Events::new([
        at("start", |t| t),
        at("touch", |t| (t - 1.0) * (t - 1.0)),
        at("pole", |t| 1.0 / (t - 1.06)),
        at("through", |t| (t - 1.0) * (t - 1.0) * (t - 1.0)),
        at("nowhere", |t| (0.5 - t).sqrt()),
    ]));
    run.advance(16).unwrap();
    assert_times(run.observer(), &[(3, true, 1.0)]);
}

#[test]
fn angles_are_counted_modulo_their_period() {
    let wrapped = |t: f64| (3.0 * t).sin().atan2((3.0 * t).cos());
    let mut run = clock(Events::new([
        at("grows", |t| 3.0 * t - 1.0).with_period(TAU),
        at("jumps", move |t| wrapped(t) - 1.0).with_period(TAU),
        at("jumps as it is", wrapped),
        at("back", |t| 1.0 - 3.0 * t)
            .with_period(TAU)
            .with_direction(-1),
    ]));
    run.advance(80).unwrap();
    let turns =
        |event, sense| (0..5).map(move |k| (event, sense, (1.0 + TAU * f64::from(k)) / 3.0));
    let of = |event| {
        let all = times(run.observer()).into_iter();
        all.filter(|found| found.0 == event).collect::<Vec<_>>()
    };
    for (event, sense) in [(0, true), (1, true), (3, false)] {
        let found = of(event);
        assert_eq!(found.len(), 5, "{found:?}");
        for (found, expected) in found.iter().zip(turns(event, sense)) {
            assert!(
                found.1 == sense && (found.2 - expected.2).abs() < 1e-12,
                "{found:?}"
            );
        }
    }
    // Not told that it is an angle; the jumps from π to −π are no roots.
    assert_eq!(of(2).len(), 4, "{:?}", of(2));
    assert!(of(2).iter().all(|found| found.1));
}

#[test]
fn an_event_may_end_the_run_and_the_run_may_go_on() {
    let events = || {
        Events::new([
            at("a", |t| (t - 1.01) * (t - 2.3)).with_end_after(1),
            at("b", |t| t - 1.05).with_end_after(1),
            at("c", |t| t - 1.08),
            at("d", |t| (3.0 * t).sin()).with_end_after(4),
        ])
    };
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} {b}");
    let mut plain = clock(Events::new([]));
    let mut run = clock(events());
    run.advance(100).unwrap();
    assert!(run.has_ended());
    near(run.time(), 1.01);
    assert_eq!(run.steps(), 9);
    near(
        run.energy(),
        System::energy(&Hand(HenonHeiles), run.state()),
    );
    // An ended run makes no step, and is saved with its end.
    run.advance(3).unwrap();
    assert_eq!(run.steps(), 9);
    let saved = run.checkpoint();
    let scheme = StormerVerlet::default();
    let again = Integrator::resume(&Hand(HenonHeiles), scheme, saved).unwrap();
    let again = again.observe(events());
    assert_eq!((again.has_ended(), again.state()), (true, run.state()));
    // It goes on: b is next, c lies in the same step, d happens for the fourth time later.
    run.go_on();
    near(run.time(), 1.125);
    run.advance(100).unwrap();
    near(run.time(), 1.05);
    run.go_on();
    run.advance(100).unwrap();
    near(run.time(), 4.0 * PI / 3.0);
    assert_eq!(run.observer().count("c"), 1);
    assert_eq!(run.observer().count("a"), 2);
    run.go_on();
    run.advance(100 - run.steps()).unwrap();
    assert_eq!(run.state(), plain.advance(100).unwrap());

    // From the end with another step: events after it are found, and it is not found again.
    let mut run = clock(events());
    run.advance(100).unwrap();
    run.change_step(0.01).unwrap();
    run.go_on();
    run.advance(100).unwrap();
    near(run.time(), 1.05);
    assert!(run.steps() < 15, "{}", run.steps());
}

#[test]
fn events_run_backwards_and_in_double_doubles() {
    let scheme = StormerVerlet::default();
    let mut run = Integrator::new(&Hand(HenonHeiles), scheme, begin(), -0.125)
        .unwrap()
        .observe(Events::new([
            at("x", |t| t + 0.3).with_direction(-1),
            at("y", |t| t + 0.8).with_direction(1),
        ]));
    run.advance(16).unwrap();
    assert_times(run.observer(), &[(0, false, -0.3)]);

    let number = |x: f64| DoubleDouble::from(x);
    let start = State::over([number(0.1), number(-0.25)], [number(0.42), number(0.1)]);
    let x = Event::of("x", |state: &State<SVector<DoubleDouble, 2>>| state.q[0]);
    let mut run = Integrator::new(&Hand(HenonHeiles), BlanesMoan4, start, number(0.1))
        .unwrap()
        .observe(Events::new([x]));
    run.advance(100).unwrap();
    assert!(run.observer().count("x") > 2);
    for state in run.observer().states("x") {
        assert!(state.q[0].abs().to_f64() < 1e-31, "{:?}", state.q[0]);
    }
}

#[test]
fn events_that_cannot_be_located_are_errors() {
    let new = || {
        let scheme = StormerVerlet::default();
        Integrator::new(&Hand(HenonHeiles), scheme, begin(), 0.125).unwrap()
    };
    let text = |error: Error| error.to_string();
    let mut run = new().observe(Events::new([Event::named("nothing")]));
    let error = run.advance(1).unwrap_err();
    assert_eq!(
        text(error),
        "the event `nothing` cannot be located: the system declares none of this name\n\
         help: declare it, `event nothing = …`"
    );
    assert!(run.advance(1).is_err());
    let swing = Integrator::new(
        &pendulum(false),
        StormerVerlet::default(),
        State::new([0.5], [0.0]),
        0.1,
    );
    let mut run = swing.unwrap().observe(Events::new([Event::named("hight")]));
    let error = text(run.advance(1).unwrap_err());
    assert!(error.ends_with("help: it declares `height`"), "{error}");
    let mut run = new().observe(Events::new([at("t", |t| t).with_period(-1.0)]));
    let error = run.advance(1).unwrap_err();
    assert_eq!(
        text(error),
        "the event `t` cannot be located: its period is not positive and finite"
    );
    let mut run = new().observe(every(2, Events::new([at("t", |t| t - 1.0)])));
    let error = run.advance(2).unwrap_err();
    assert_eq!(
        text(error),
        "the event `t` cannot be located: its observer does not receive every step"
    );
    // Another event than the saved run had.
    let mut run = new().observe(Events::new([at("t", |t| t - 1.0)]));
    run.advance(2).unwrap();
    let saved = run.checkpoint();
    for other in [vec![at("u", |t| t)], vec![at("t", |t| t), at("u", |t| t)]] {
        let scheme = StormerVerlet::default();
        let again = Integrator::resume(&Hand(HenonHeiles), scheme, saved.clone()).unwrap();
        let error = again.observe(Events::new(other)).advance(1).unwrap_err();
        assert!(matches!(error, Error::Checkpoint(_)), "{error}");
    }
}

/// At given times: the states of `states_at`, whatever else watches, and in a run that is resumed.
#[test]
fn outputs_at_times_are_those_of_the_run() {
    let grid = || (0..).map(|k| 0.07 * f64::from(k));
    let new = || {
        let scheme = StormerVerlet::default();
        Integrator::new(&Hand(HenonHeiles), scheme, begin(), 0.125).unwrap()
    };
    let watch = || (EnergyDrift::new(), at_times(grid(), Recorder::new()));
    let mut run = new().observe(watch());
    run.advance(80).unwrap();
    let recorder = run.observer().1.inner();
    let mut plain = new();
    let expected = plain.states_at(grid().take_while(|t| *t <= 10.0));
    let mut rows = recorder.iter();
    for state in expected {
        let state = state.unwrap();
        let row = rows.next().unwrap();
        assert_eq!(row[0], state.t);
        for (a, b) in row[1..].iter().zip(state.q.iter().chain(&state.p)) {
            assert!((a - b).abs() < 1e-15);
        }
    }
    assert!(rows.next().is_none());
    for made in [0, 33] {
        let mut first = new().observe(watch());
        first.advance(made).unwrap();
        let saved = first.checkpoint();
        let scheme = StormerVerlet::default();
        let again = Integrator::resume(&Hand(HenonHeiles), scheme, saved).unwrap();
        let mut again = again.observe(watch());
        again.advance(80 - made).unwrap();
        assert_eq!(again.observer().1.inner(), recorder);
        assert_eq!(again.state(), run.state());
    }
    // A time behind the start is an error.
    let mut behind = new().observe(at_times([-1.0, 1.0], Recorder::new()));
    let error = behind.advance(1).unwrap_err();
    assert!(
        matches!(
            error,
            Error::Time(TimeError::Behind {
                target: -1.0,
                now: 0.0,
                ..
            })
        ),
        "{error}"
    );
    // An observer may end the run there.
    let mut run = new().observe(at_times(grid(), Until(0.5)));
    run.advance(80).unwrap();
    assert_eq!(run.time(), 0.07 * 8.0);
}

/// Ends the run past a time.
struct Until(f64);

impl<S: System> Observer<f64, S> for Until {
    fn observe(&mut self, view: &View<'_, f64, S>) -> ControlFlow<()> {
        match view.state.t > self.0 {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    }
}
