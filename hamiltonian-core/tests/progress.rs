//! The progress bar: where it stands, when it is finished, that it changes nothing.

use crate::common::systems::*;
use core::ops::ControlFlow;
use hamiltonian_core::observers::Progress;
use hamiltonian_core::prelude::*;
use indicatif::ProgressBar;

fn hidden(steps: u64) -> Progress {
    Progress::with_bar(steps, ProgressBar::hidden())
}

fn run() -> Run<Hand<Pendulum, 1>, Strang> {
    let start = State::new([0.3], [0.1]);
    Integrator::new(&pendulum(true), Strang, start, 0.01).unwrap()
}

#[test]
fn the_bar_stands_where_the_run_does() {
    let mut plain = run();
    // Divisible by a thousand and not; fewer steps than a thousand.
    for steps in [20_000, 20_011, 7] {
        let mut run = run().observe(hidden(steps));
        let bar = run.observer().bar().clone();
        assert_eq!((bar.length(), bar.position()), (Some(steps), 0));
        run.advance(steps / 2).unwrap();
        let interval = (steps / 1000).max(1);
        assert_eq!(bar.position(), steps / 2 / interval * interval);
        assert!(!bar.is_finished());
        run.advance(steps - steps / 2).unwrap();
        assert!(bar.is_finished(), "{steps}");
        assert_eq!(bar.position(), steps);
        // Beyond its end it stays.
        run.advance(100).unwrap();
        assert_eq!(bar.position(), steps);
    }
    let mut watched = run().observe(hidden(500));
    assert_eq!(watched.advance(500).unwrap(), plain.advance(500).unwrap());
}

#[test]
fn it_counts_from_where_it_is_attached() {
    let mut begun = run();
    begun.advance(33).unwrap();
    let mut begun = begun.observe(hidden(100));
    let bar = begun.observer().bar().clone();
    begun.advance(40).unwrap();
    assert_eq!(bar.position(), 40);
    // A saved run goes on where it stood.
    let mut again = Integrator::resume(&pendulum(true), Strang, begun.checkpoint())
        .unwrap()
        .observe(hidden(100));
    again.advance(1).unwrap();
    assert_eq!(again.observer().bar().position(), 41);
    again.advance(59).unwrap();
    assert!(again.observer().bar().is_finished() && !bar.is_finished());
}

#[test]
fn the_bar_of_a_run_that_ends_is_left() {
    let end = watch(
        |view: &hamiltonian_core::View<'_, f64, _>| match view.steps {
            60 => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        },
    );
    let mut run = run().observe((hidden(100), end));
    run.advance(100).unwrap();
    let bar = run.observer().0.bar();
    assert_eq!((bar.position(), bar.is_finished()), (60, false));
}
