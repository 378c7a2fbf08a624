//! Runs that are changed between two steps: the state, the parameters.

use crate::common::systems::*;
use hamiltonian_core::errors::{StartError, TimeError};
use hamiltonian_core::prelude::*;
use hamiltonian_core::schemes::{Tao, TwoStepMidpoint};
use hamiltonian_core::{Real, Scheme, private::SVector};

type Start = State<SVector<f64, 2>>;

fn start() -> Start {
    State::new([0.1, -0.25], [0.3, 0.1])
}

fn kicked(state: &Start) -> Start {
    let mut kicked = state.clone();
    kicked.p[0] += 0.05;
    kicked
}

/// A changed run is a new run from the new state, at the times and step numbers of the old one.
#[test]
fn a_changed_run_goes_on_as_a_new_one() {
    fn of<M: Scheme<Hand<HenonHeiles, 2>>>(scheme: M) {
        let system = Hand(HenonHeiles);
        let mut run = Integrator::new(&system, scheme.clone(), start().at(0.7), 0.1).unwrap();
        run.advance(37).unwrap();
        let state = kicked(run.state());
        run.set_state(state.clone()).unwrap();
        assert_eq!(run.state(), &state);
        let mut new = Integrator::new(&system, scheme, state, 0.1).unwrap();
        for k in 38..2_000 {
            let [changed, fresh] = [run.advance(1), new.advance(1)].map(Result::unwrap);
            assert_eq!([&changed.q, &changed.p], [&fresh.q, &fresh.p]);
            assert_eq!(changed.t, 0.7 + k as f64 * 0.1);
        }
        assert_eq!(run.steps(), 1_999);
        run.advance_to(0.7 + 300.0).unwrap();
        assert_eq!(run.steps(), 3_000);
        assert!(matches!(
            run.advance_to(300.0),
            Err(Error::Time(TimeError::Behind { .. }))
        ));
    }
    of(StormerVerlet::KickDriftKick);
    of(StormerVerlet::DriftKickDrift);
    of(RungeKutta4);
    of(Gauss::<2>::default());
    // What these carry beside the state is made anew.
    of(TwoStepMidpoint::default());
    of(Tao::default());
}

/// The same orbit in blocks, and from a checkpoint after the change.
#[test]
fn a_changed_run_is_saved_with_its_change() {
    let system = Hand(HenonHeiles);
    let scheme = StormerVerlet::default();
    let mut run = Integrator::new(&system, scheme, start(), 0.1).unwrap();
    run.advance(11).unwrap();
    run.set_state(kicked(run.state())).unwrap();
    run.advance(5).unwrap();
    run.set_state(kicked(run.state())).unwrap();
    run.advance(3).unwrap();
    let saved = Checkpoint::from_bytes(&run.checkpoint().to_bytes()).unwrap();
    let mut again = Integrator::resume(&system, scheme, saved).unwrap();
    assert_eq!(again.advance(2_000).unwrap(), run.advance(2_000).unwrap());
    assert_eq!(again.steps(), run.steps());
}

/// A refused state changes nothing.
#[test]
fn a_state_that_cannot_be_a_start_is_refused() {
    let system = Hand(HenonHeiles);
    let mut run = Integrator::new(&system, StormerVerlet::default(), start(), 0.1)
        .unwrap()
        .observe(EnergyDrift::new());
    run.advance(10).unwrap();
    let mut twin = run.clone();
    let other = run.set_state(start());
    assert!(
        matches!(other, Err(Error::Start(StartError::OtherTime { time: 0.0, now, .. })) if now == 1.0),
        "{other:?}"
    );
    let message = other.unwrap_err().to_string();
    assert_eq!(
        message,
        "the new state is at t = 0, the run at t = 1: a change keeps the time, give the state that of the run, \
         `state.at(run.state().t)`"
    );
    run.set_state(start().at(1.0)).unwrap();
    run.set_state(twin.state().clone()).unwrap();
    let mut bad = twin.state().clone();
    bad.q[1] = f64::NAN;
    let mut run = twin.clone();
    assert!(matches!(
        run.set_state(bad),
        Err(Error::Start(StartError::NotFinite { .. }))
    ));
    let mut far = twin.state().clone();
    far.q[1] = 1e200;
    assert!(matches!(
        run.set_state(far),
        Err(Error::Start(StartError::Values { .. }))
    ));
    run.advance(50).unwrap();
    twin.advance(50).unwrap();
    assert_eq!(
        (run.state(), run.observer()),
        (twin.state(), twin.observer())
    );
}

/// A kick is no drift, and the mean of H is that of the states.
#[test]
fn the_drift_of_energy_leaves_out_the_change() {
    let system = Hand(HenonHeiles);
    let energy = |state: &Start| system.energy(state);
    let mut run = Integrator::new(&system, StormerVerlet::default(), start(), 0.05)
        .unwrap()
        .observe((EnergyDrift::new(), every(7, EnergyDrift::new())));
    let (mut sum, mut count) = (energy(run.state()), 1.0);
    let mut given = 0.0;
    for _ in 0..9 {
        for _ in 0..100 {
            sum += energy(run.advance(1).unwrap());
            count += 1.0;
        }
        let to = kicked(run.state());
        given += energy(&to) - energy(run.state());
        run.set_state(to).unwrap();
    }
    assert!(given.abs() > 1e-2, "the kicks change H: {given}");
    let drift = run.observer().0.drift().unwrap();
    assert!(drift.max_absolute() < 2e-4, "{}", drift.max_absolute());
    assert!(run.observer().1.inner().drift().unwrap().max_absolute() < 2e-4);
    assert!((drift.start() - energy(&start()) - given).abs() < 1e-15);
    assert!((drift.mean() - sum / count).abs() < 1e-14);
    // Without the hook the kicks would be a drift.
    let mut plain = Deaf(EnergyDrift::new());
    let mut run = Integrator::new(&system, StormerVerlet::default(), start(), 0.05)
        .unwrap()
        .observe(&mut plain);
    run.advance(100).unwrap();
    run.set_state(kicked(run.state())).unwrap();
    run.advance(100).unwrap();
    assert!(plain.0.drift().unwrap().max_absolute() > 2e-3);
}

/// An observer that does not receive changes.
struct Deaf<O>(O);

impl<T: Real, S: System, O: Observer<T, S>> Observer<T, S> for Deaf<O> {
    fn observe(&mut self, view: &hamiltonian_core::View<'_, T, S>) -> std::ops::ControlFlow<()> {
        self.0.observe(view)
    }
}

/// No event lies between the two states of a change, and those after it are found.
#[test]
fn no_event_is_sought_in_a_change() {
    let system = pendulum(true);
    let bottom = || {
        Events::new([Event::of("bottom", |state: &State<SVector<f64, 1>>| {
            state.q[0]
        })])
    };
    let begin = State::new([0.5], [0.0]);
    let run = |observer| {
        let mut run = Integrator::new(&system, StormerVerlet::default(), begin.clone(), 0.1)
            .unwrap()
            .observe(observer);
        run.advance(3).unwrap();
        let mut across = run.state().clone();
        across.q[0] = -across.q[0];
        run.set_state(across).unwrap();
        run
    };
    let mut run = run(bottom());
    run.advance(1).unwrap();
    assert_eq!(run.observer().count("bottom"), 0);
    run.advance(1_000).unwrap();
    let count = run.observer().count("bottom");
    assert!(count > 5, "{count}");
    assert!(
        run.observer()
            .located()
            .iter()
            .all(|one| one.state.q[0].abs() < 1e-12)
    );
    // The same of an observer that is not told.
    let mut deaf = Deaf(bottom());
    let mut run = Integrator::new(&system, StormerVerlet::default(), begin.clone(), 0.1)
        .unwrap()
        .observe(&mut deaf);
    run.advance(3).unwrap();
    let mut across = run.state().clone();
    across.q[0] = -across.q[0];
    run.set_state(across).unwrap();
    run.advance(1).unwrap();
    assert_eq!(deaf.0.count("bottom"), 1);
}

/// A ball that is thrown back by a wall: a run that an event ended goes on from the changed state there.
#[test]
fn a_run_that_an_event_ended_goes_on_from_the_change() {
    let system = pendulum(true);
    let wall = Event::of("wall", |state: &State<SVector<f64, 1>>| state.q[0] - 0.2)
        .with_direction(1)
        .with_end_after(1);
    let mut run = Integrator::new(
        &system,
        StormerVerlet::default(),
        State::new([-0.5], [0.0]),
        0.01,
    )
    .unwrap()
    .observe(Events::new([wall]));
    let energy = system.energy(run.state());
    run.advance(100_000).unwrap();
    assert!(run.has_ended());
    let (steps, t) = (run.steps(), run.time());
    let mut back = run.state().clone();
    assert!((back.q[0] - 0.2).abs() < 1e-12 && back.p[0] > 0.0);
    back.p[0] = -back.p[0];
    run.set_state(back.clone()).unwrap();
    assert_eq!((run.state(), run.steps(), run.time()), (&back, steps, t));
    run.go_on();
    let q = run.advance(1).unwrap().q[0];
    assert!(q < 0.2 && run.time() == t + 0.01, "it goes back");
    // It ends at the first event alone; the second is that of the way back.
    run.advance(2_000).unwrap();
    let states: Vec<_> = run.observer().states("wall").collect();
    assert!(states.len() > 1 && !run.has_ended());
    assert!((states[1].p[0] - states[0].p[0]).abs() < 1e-3 * states[0].p[0]);
    assert!((system.energy(run.state()) - energy).abs() < 1e-3 * energy.abs());
}

/// States at given times between steps come from the side of the change on which they lie.
#[test]
fn states_at_times_lie_on_their_side_of_a_change() {
    let system = Hand(HenonHeiles);
    let times = [0.25, 0.35, 0.95];
    let mut run = Integrator::new(&system, Gauss::<4>::default(), start(), 0.1)
        .unwrap()
        .observe(at_times(times, Recorder::new()));
    run.advance(3).unwrap();
    let to = kicked(run.state());
    run.set_state(to.clone()).unwrap();
    run.advance(10).unwrap();
    let p = run
        .observer()
        .inner()
        .column("p_x")
        .unwrap()
        .collect::<Vec<_>>();
    let at = |from: Start, t| {
        let run = Integrator::new(&system, Gauss::<8>::default(), from, 0.01).unwrap();
        let mut run = run;
        run.advance_until(t).unwrap().p[0]
    };
    for (found, due) in p
        .iter()
        .zip([at(start(), 0.25), at(to.clone(), 0.35), at(to, 0.95)])
    {
        assert!((found - due).abs() < 1e-10, "{found} {due}");
    }
    assert_eq!(p.len(), 3);
}

/// An event ends the run between two steps, and an observer of every second state has not received the step before.
/// Times before the event are passed on, though the run is changed there.
#[test]
fn times_before_a_change_are_not_lost() {
    let system = pendulum(true);
    let run = |from: f64| {
        let wall = Event::of("wall", |state: &State<SVector<f64, 1>>| state.q[0] - 0.2);
        let events = Events::new([wall.with_direction(1).with_end_after(1)]);
        let start = State::new([-0.5], [0.0]);
        let times = at_times([from], Recorder::new());
        Integrator::new(&system, StormerVerlet::default(), start, 0.1)
            .unwrap()
            .observe((events, every(2, times)))
    };
    let mut first = run(1e9);
    first.advance(100_000).unwrap();
    // The number of steps before the event is odd: the last state that the observer received is a step older.
    let (steps, end) = (first.steps(), first.time());
    assert!(first.has_ended() && steps % 2 == 1, "{steps}");
    let t = 0.1 * (steps - 1) as f64 + 0.02;
    assert!(t < end);
    let mut run = run(t);
    run.advance(100_000).unwrap();
    let mut back = run.state().clone();
    back.p[0] = -back.p[0];
    run.set_state(back).unwrap();
    run.go_on();
    run.advance(3).unwrap();
    let recorder = run.observer().1.inner().inner();
    let [theta, p] = ["theta", "p"].map(|name| recorder.column(name).unwrap().next().unwrap());
    assert!(theta < 0.2 && p > 0.0, "before the wall: {theta} {p}");
}
