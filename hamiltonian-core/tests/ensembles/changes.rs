//! Members that are changed between two steps are single runs that are changed.

use super::*;
use hamiltonian::Scheme;
use hamiltonian::errors::{StartError, SweepError};

fn swaying(member: Member) -> (Pendulum, StateOf<Pendulum>) {
    let at = part(member.index);
    let system = Pendulum {
        l: 1.0 + 0.2 * at,
        ..Default::default()
    };
    (system, State::new([1.5 * at - 0.7], [0.4]))
}

/// Kicks of some members, at some times.
fn kick(member: Member, state: &mut StateOf<Pendulum>) {
    if member.index % 3 != 1 {
        state.p[0] = 0.9 * state.p[0] + 0.05 * (member.index as f64).sin();
    }
}

type Observers = (EnergyDrift, Events<hamiltonian::private::SVector<f64, 1>>);

fn observers() -> Observers {
    (EnergyDrift::new(), Events::new([Event::named("bottom")]))
}

/// A single run with the same kicks.
fn single<M: Scheme<Pendulum>>(
    scheme: M,
    index: usize,
    rounds: usize,
) -> (StateOf<Pendulum>, Observers) {
    let (system, start) = swaying(Member::new(index, 0));
    let mut run = Integrator::new(&system, scheme, start, 0.05)
        .unwrap()
        .observe(observers());
    for round in 1..=rounds {
        run.advance(20).unwrap();
        if round < rounds {
            let mut state = run.state().clone();
            kick(Member::new(index, 0), &mut state);
            if &state != run.state() {
                run.set_state(state).unwrap();
            }
        }
    }
    let state = run.state().clone();
    (state, run.observer().clone())
}

const MEMBERS: usize = 100;
const ROUNDS: usize = 6;

fn of<M: Scheme<Pendulum>>(scheme: M) {
    let singles: Vec<_> = (0..MEMBERS)
        .map(|index| single(scheme.clone(), index, ROUNDS))
        .collect();
    at_each_level(|_| are_changed(&scheme, &singles));
}

/// Members of an ensemble and of a sweep, and of a resumed ensemble, are these single runs.
fn are_changed<M: Scheme<Pendulum>>(scheme: &M, singles: &[(StateOf<Pendulum>, Observers)]) {
    let mut swarm = Ensemble::new(MEMBERS, swaying, scheme.clone(), 0.05)
        .unwrap()
        .reproducible()
        .observe(|_| observers());
    let mut saved = None;
    for round in 1..=ROUNDS {
        swarm.advance(20);
        if round < ROUNDS {
            swarm.update(kick);
        }
        if round == 3 {
            saved = Some(swarm.checkpoint());
        }
    }
    let table = Sweep::new(MEMBERS, swaying, scheme.clone(), 0.05)
        .with_steps(20 * ROUNDS as u64)
        .each(20, kick)
        .observe(|_| observers())
        .reproducible()
        .record(["q", "p", "drift", "bottoms"], |end| {
            let (drift, events) = end.observer;
            let bottoms = events.count("bottom") as f64;
            [
                end.state.q[0],
                end.state.p[0],
                drift.drift().unwrap().max_absolute(),
                bottoms,
            ]
        })
        .collect()
        .unwrap();
    let column = |name: &str| table.column(name).unwrap().collect::<Vec<_>>();
    let columns = ["q", "p", "drift", "bottoms"].map(column);
    let mut again = Ensemble::resume_reproducible(MEMBERS, swaying, scheme.clone(), saved.unwrap())
        .unwrap()
        .observe(|_| observers());
    for round in 4..=ROUNDS {
        again.advance(20);
        if round < ROUNDS {
            again.update(kick);
        }
    }
    assert_eq!(swarm.states().count(), singles.len());
    for (index, (state, single)) in swarm.states().zip(singles).enumerate() {
        let state = state.unwrap();
        let (alone, (drift, events)) = single;
        assert_eq!(&state, alone, "member {index}");
        let own = swarm.observers().nth(index).unwrap();
        assert_eq!(own.1.located(), events.located(), "member {index}");
        let [here, there] = [&own.0, drift].map(|one| one.drift().unwrap().max_absolute());
        assert!(
            (here - there).abs() <= 1e-14,
            "member {index}: {here} {there}"
        );
        let row: [f64; 4] = core::array::from_fn(|k| columns[k][index]);
        assert_eq!(
            [row[0], row[1], row[3]],
            [state.q[0], state.p[0], events.count("bottom") as f64]
        );
        assert!(
            (row[2] - there).abs() <= 1e-14,
            "member {index}: {} {there}",
            row[2]
        );
    }
    assert!(
        again
            .states()
            .map(Result::unwrap)
            .eq(swarm.states().map(Result::unwrap))
    );
    // The kicks are no drift, but they change the members that receive them.
    let mut calm = Ensemble::new(MEMBERS, swaying, scheme.clone(), 0.05)
        .unwrap()
        .reproducible();
    calm.advance(20 * ROUNDS as u64);
    for (index, (calm, kicked)) in calm.states().zip(swarm.states()).enumerate() {
        assert_eq!(
            calm.unwrap() == kicked.unwrap(),
            index % 3 == 1,
            "member {index}"
        );
    }
}

#[test]
fn changed_members_are_changed_single_runs() {
    of(StormerVerlet::default());
    of(Gauss::<2>::default());
}

/// A state that cannot be a start is the error of its member alone.
#[test]
fn a_bad_change_is_the_error_of_its_member() {
    let mut swarm = Ensemble::new(20, swaying, StormerVerlet::default(), 0.05).unwrap();
    swarm.advance(10);
    swarm.update(|member, state| match member.index {
        3 => state.q[0] = f64::NAN,
        5 => state.t += 1.0,
        7 => panic!("of the closure"),
        _ => {}
    });
    swarm.advance(10);
    for (index, state) in swarm.states().enumerate() {
        let error = |state: Result<StateOf<Pendulum>, Error>| match state {
            Err(Error::Sweep(SweepError::Member { error, .. })) => Some(*error),
            _ => None,
        };
        let found = error(state);
        match index {
            3 => assert!(matches!(
                found,
                Some(Error::Start(StartError::NotFinite { .. }))
            )),
            5 => assert!(matches!(
                found,
                Some(Error::Start(StartError::OtherTime { .. }))
            )),
            7 => assert!(matches!(
                found,
                Some(Error::Sweep(SweepError::Panicked { .. }))
            )),
            _ => assert!(found.is_none(), "{found:?}"),
        }
    }
    let table = Sweep::new(20, swaying, StormerVerlet::default(), 0.05)
        .with_steps(30)
        .each(10, |member, state| {
            if member.index == 3 {
                state.q[0] = f64::NAN;
            }
        })
        .record(["q"], |end| [end.state.q[0]])
        .collect()
        .unwrap();
    let good = table.column("q").unwrap().filter(|q| q.is_finite());
    assert_eq!(good.count(), 19);
}

/// Times between the step of a change and the next one are reached from the changed state; the time of that step is
/// recorded before the change.
#[test]
fn a_sweep_records_states_on_their_side_of_a_change() {
    let times = [0.99, 1.0, 1.013, 1.04, 1.21];
    let table = Sweep::new(MEMBERS, swaying, StormerVerlet::default(), 0.05)
        .each(20, kick)
        .reproducible()
        .record_at(times, ["q", "p"], |at| [at.state.q[0], at.state.p[0]])
        .collect()
        .unwrap();
    let [q, p] = ["q", "p"].map(|name| table.column(name).unwrap().collect::<Vec<_>>());
    let mut differs = false;
    for index in 0..MEMBERS {
        let (system, start) = swaying(Member::new(index, 0));
        let mut run = Integrator::new(&system, StormerVerlet::default(), start, 0.05).unwrap();
        run.advance(20).unwrap();
        let before = run.state().clone();
        let mut state = before.clone();
        kick(Member::new(index, 0), &mut state);
        let early = run.state_at(0.99).unwrap();
        let unchanged = run.state_at(1.013).unwrap();
        if state != before {
            run.set_state(state).unwrap();
        }
        let near = [1.013, 1.04].map(|t| run.state_at(t).unwrap());
        run.advance(4).unwrap();
        let [first, second] = near;
        differs |= first != unchanged;
        let late = run.state_at(1.21).unwrap();
        let due = [early, before, first, second, late];
        for (k, due) in due.iter().enumerate() {
            let row = times.len() * index + k;
            // A state before the step is reached from the step before it.
            let tolerance = if k == 0 { 1e-4 } else { 0.0 };
            let [there_q, there_p] = [due.q[0], due.p[0]];
            let off = (q[row] - there_q).abs().max((p[row] - there_p).abs());
            assert!(off <= tolerance, "member {index}, time {}: {off}", times[k]);
        }
    }
    assert!(differs, "no kick is seen between steps");
}
