//! Between steps: states by parts of a step, roots of events, times off the grid, other steps, ends.

use crate::common::difference;
use crate::common::systems::*;
use core::ops::ControlFlow;
use hamiltonian_core::AnyRun;
use hamiltonian_core::errors::{StepError, TimeError};
use hamiltonian_core::prelude::*;
use hamiltonian_core::private::SVector;
use hamiltonian_core::schemes::{Composition, IntersectingSubTrajectories, Pihajoki};
use hamiltonian_core::{Scheme, Vector, View};

type Heiles = Hand<HenonHeiles, 2>;
type Plane = State<SVector<f64, 2>>;

fn begin() -> Plane {
    State::new([0.1, -0.25], [0.42, 0.1])
}

/// The times at which x rises through 0 until t = 20, by bisection in the step that has a sign
/// change; the last state of the run, and the largest |x| at a root.
fn crossings<M: Scheme<Heiles>>(scheme: M, h: f64) -> (Vec<f64>, Plane, f64) {
    let mut times = Vec::new();
    let mut largest = 0.0_f64;
    let mut before = begin().q[0];
    let last = {
        let mut run = Integrator::new(&Hand(HenonHeiles), scheme, begin(), h)
            .unwrap()
            .watch(1, |view: &View<'_, f64, Heiles>| {
                let here = view.state.q[0];
                if before < 0.0 && here >= 0.0 {
                    // x < 0 at low, x ≥ 0 at high, both within the step that led here.
                    let (mut low, mut high) = (view.state.t - h, view.state.t);
                    for _ in 0..60 {
                        let middle = 0.5 * (low + high);
                        let x = view.state_at(middle).unwrap().q[0];
                        if x < 0.0 {
                            low = middle;
                        } else {
                            high = middle;
                        }
                    }
                    largest = largest.max(view.state_at(high).unwrap().q[0].abs());
                    times.push(high);
                }
                before = here;
            });
        run.advance_to(20.0).unwrap().clone()
    };
    (times, last, largest)
}

/// Roots are those of the scheme's order, and nobody asked as far as the run is concerned.
fn roots_of_order<M: Scheme<Heiles>>(scheme: M, order: f64) {
    let name = scheme.entry().name;
    let roots: Vec<Vec<f64>> = [0.1, 0.05, 0.025]
        .into_iter()
        .map(|h| {
            let (times, last, largest) = crossings(scheme.clone(), h);
            assert!(largest <= 1e-13, "{name}: |x| = {largest:e}");
            let mut plain =
                Integrator::new(&Hand(HenonHeiles), scheme.clone(), begin(), h).unwrap();
            assert_eq!(plain.advance_to(20.0).unwrap(), &last, "{name}");
            times
        })
        .collect();
    assert!(roots[0].len() >= 2, "{name}: {roots:?}");
    let worst = |a: &[f64], b: &[f64]| {
        assert_eq!(a.len(), b.len(), "{name}");
        let apart = a.iter().zip(b).map(|(a, b)| (a - b).abs());
        apart.fold(0.0, f64::max)
    };
    let slope = (worst(&roots[0], &roots[1]) / worst(&roots[1], &roots[2])).log2();
    assert!((slope - order).abs() < 0.3, "{name}: {slope}");
}

#[test]
fn roots_of_events_by_parts_of_steps() {
    roots_of_order(StormerVerlet::KickDriftKick, 2.0);
    roots_of_order(ImplicitMidpoint::default(), 2.0);
    roots_of_order(IntersectingSubTrajectories::default(), 2.0);
    roots_of_order(Composition::yoshida(StormerVerlet::DriftKickDrift), 4.0);
    roots_of_order(RungeKutta4, 4.0);
}

/// A part that fails says so; the run stands where it stood.
#[test]
fn parts_fail_like_steps() {
    let scheme = ImplicitMidpoint::default().with_max_iterations(3);
    let start = State::new([1.0], [0.3]);
    let run = Integrator::new(&Hand(Paper34), scheme, start.clone(), 0.5).unwrap();
    match run.state_at(0.3).unwrap_err() {
        Error::Step(StepError::Unsolved {
            iterations: 3,
            time: 0.0,
            ..
        }) => {}
        other => panic!("{other:?}"),
    }
    assert_eq!(run.state(), &start);
}

#[test]
fn any_time_on_request() {
    let new = || Integrator::new(&Hand(HenonHeiles), RungeKutta4, begin(), 0.01).unwrap();
    let mut fine = Integrator::new(&Hand(HenonHeiles), RungeKutta4, begin(), 0.01 / 128.0).unwrap();
    let mut run = new();
    // On the grid it is a step of the run, off it a part of one.
    assert_eq!(&run.advance_until(0.5).unwrap(), new().advance(50).unwrap());
    assert_eq!(run.steps(), 50);
    let off = run.advance_until(1.005).unwrap();
    assert_eq!((off.t, run.steps()), (1.005, 100));
    assert!(difference(&off, fine.advance_to(1.005).unwrap()) < 1e-10);
    assert_eq!(run.state(), new().advance(100).unwrap());
    // Again from the middle of the step, then behind.
    assert_eq!(run.advance_until(1.005).unwrap(), off);
    let behind = run.advance_until(0.99).unwrap_err();
    assert!(
        behind
            .to_string()
            .contains("0.99 lies behind the run, which is at t = 1")
    );
    for t in [f64::NAN, f64::INFINITY] {
        let beyond = run.advance_until(t).unwrap_err();
        assert!(
            matches!(beyond, Error::Time(TimeError::Unreachable { .. })),
            "{beyond}"
        );
    }
    assert_eq!(run.steps(), 100);

    let times = [0.0, 0.125, 0.5, 0.5004, 0.5006, 2.0];
    let mut run = new();
    let states: Vec<_> = run.states_at(times).map(Result::unwrap).collect();
    assert!(states.iter().map(|state| state.t).eq(times));
    let mut one_by_one = new();
    for (state, t) in states.iter().zip(times) {
        assert_eq!(state, &one_by_one.advance_until(t).unwrap());
    }
    // The first error is the last item.
    let mut run = new();
    let items: Vec<_> = run.states_at([0.1, 0.05, 0.2]).collect();
    assert_eq!(items.len(), 2);
    assert!(items[0].is_ok() && matches!(items[1], Err(Error::Time(TimeError::Behind { .. }))));
    // Backwards.
    let mut back = Integrator::new(&Hand(HenonHeiles), RungeKutta4, begin(), -0.01).unwrap();
    assert_eq!(back.advance_until(-0.335).unwrap().t, -0.335);
    assert_eq!(back.steps(), 33);
}

#[test]
fn a_changed_step_makes_a_new_copy() {
    let mut run = Integrator::new(
        &Hand(Paper34),
        Pihajoki::default(),
        State::new([-3.0], [0.0]),
        0.01,
    )
    .unwrap();
    run.advance(300).unwrap();
    assert!(run.copy_distance() > 1e-3);
    run.change_step(0.005).unwrap();
    assert_eq!(run.copy_distance(), 0.0);
}

/// An observer ends a run at its state, whichever call makes the steps.
#[test]
fn observers_end_runs() {
    let new = || {
        let run = Integrator::new(&Hand(HenonHeiles), Strang, begin(), 0.01).unwrap();
        run.watch(5, |view: &View<'_, f64, Heiles>| match view.steps {
            40 => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        })
    };
    let mut plain = Integrator::new(&Hand(HenonHeiles), Strang, begin(), 0.01).unwrap();
    let expected = plain.advance(40).unwrap().clone();

    let mut run = new();
    assert_eq!(run.advance(3000).unwrap(), &expected);
    assert!(run.has_ended() && run.steps() == 40);
    // It stays ended, until it is told to go on.
    assert_eq!(run.advance(7).unwrap(), &expected);
    run.go_on();
    run.advance(7).unwrap();
    assert_eq!((run.steps(), run.has_ended()), (47, false));
    assert_eq!(run.state(), plain.advance(7).unwrap());

    let mut run = new();
    assert_eq!(run.advance_to(10.0).unwrap(), &expected);
    let mut run = new();
    assert_eq!(run.advance_until(7.777).unwrap(), expected);
    let mut run = new();
    assert_eq!(run.states(9).last().unwrap().unwrap(), expected);
    assert_eq!(run.states(9).count(), 0);
    let mut run = new();
    let states: Vec<_> = run.states_at([0.1, 0.2, 0.9, 1.7]).collect();
    assert_eq!(states.len(), 3);
    assert_eq!(states[2].as_ref().unwrap(), &expected);
    // At the first state already, where it is attached.
    let mut run = Integrator::new(&Hand(HenonHeiles), Strang, begin(), 0.01)
        .unwrap()
        .watch(1, |_| ControlFlow::Break(()));
    assert_eq!(run.advance(10).unwrap(), &begin());
    // One of a tuple is enough; the others are shown that state too.
    let mut seen = 0;
    let mut run = new().watch(1, |_| seen += 1);
    run.advance(3000).unwrap();
    assert_eq!(run.steps(), 40);
    drop(run);
    assert_eq!(seen, 41);
}

/// Different systems and schemes in one table.
#[test]
fn a_table_of_different_runs() {
    let paper = State::new([-3.0], [0.0]);
    let chain = State::new(vec![0.1, 0.0, -0.2], vec![0.0, 0.3, 0.1]);
    let mut runs: Vec<Box<dyn AnyRun>> = vec![
        Box::new(Integrator::new(&Hand(HenonHeiles), Strang, begin(), 0.01).unwrap()),
        Box::new(
            Integrator::new(&Hand(Paper34), ImplicitMidpoint::default(), paper, 0.01)
                .unwrap()
                .observe(EnergyDrift::new()),
        ),
        Box::new(Integrator::new(&Chain { n: 3 }, RungeKutta4, chain, 0.01).unwrap()),
        Box::new(Integrator::new(&pendulum(true), Strang, State::new([0.3], [0.0]), 0.01).unwrap()),
    ];
    let lines: Vec<String> = (runs.iter_mut())
        .map(|run| {
            let before = run.energy();
            run.advance(100).unwrap();
            assert!((run.energy() - before).abs() < 1e-3 * before);
            assert_eq!(
                (run.steps(), run.time(), run.has_ended()),
                (100, 1.0, false)
            );
            assert_eq!(run.names().len(), run.values().len());
            format!(
                "{} {} {}",
                run.system(),
                run.entry().name,
                run.names().join(" ")
            )
        })
        .collect();
    assert_eq!(
        lines,
        [
            "HenonHeiles Strang x y p_x p_y",
            "Paper34 ImplicitMidpoint q p",
            "Chain RungeKutta4 q[0] q[1] q[2] p[0] p[1] p[2]",
            "Pendulum Strang theta p",
        ]
    );
    let height = runs[3].observable("height").unwrap();
    assert_eq!(height, -10.0 * runs[3].values()[0].cos());
    assert_eq!(runs[3].observable("depth"), None);
}

#[test]
fn a_recorder_with_the_energy() {
    let mut run = Integrator::new(&Hand(HenonHeiles), Strang, begin(), 0.01)
        .unwrap()
        .observe(every(50, Recorder::new().with_energy()));
    run.advance(100).unwrap();
    let recorder = run.observer().inner();
    assert_eq!(recorder.columns(), ["t", "x", "y", "p_x", "p_y", "H"]);
    let energies: Vec<f64> = recorder.column("H").unwrap().collect();
    assert_eq!(energies[2], run.energy());
    let system: &dyn Fn(&Plane) -> f64 = &|state| Hand(HenonHeiles).energy(state);
    assert_eq!((energies[0], energies.len()), (system(&begin()), 3));
}

/// Slices and `&Vec` are starts of run-time size; rows are bodies.
#[test]
fn starts_from_slices() {
    let (q, p) = (vec![0.1, 0.2], vec![0.0, 0.3]);
    let owned = State::new(q.clone(), p.clone());
    assert_eq!(State::new(&q, &p), owned);
    assert_eq!(State::new(q.as_slice(), p.as_slice()), owned);
    let rows = vec![[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]];
    let owned = State::new(rows.clone(), rows.clone());
    assert_eq!(State::new(&rows, &rows), owned);
    assert_eq!(State::new(rows.as_slice(), rows.as_slice()), owned);
    assert_eq!((owned.q[(1, 2)], owned.q.len()), (6.0, 6));
    assert_eq!(Vector::component(&owned.q, 1), 4.0);
}
