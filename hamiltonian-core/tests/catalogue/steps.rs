//! Parts of steps, and changed steps.

use crate::common::difference;
use crate::common::systems::*;
use crate::common::walk::{Sample, everywhere};
use crate::saved::watchers;
use hamiltonian_core::Scheme;
use hamiltonian_core::errors::{StartError, TimeError};
use hamiltonian_core::prelude::*;
use hamiltonian_core::private::SVector;
use hamiltonian_core::schemes::Srkn6b;
use hamiltonian_core::schemes::walk::{
    Visitor, visit_any, visit_separable, visit_split, visit_unforced,
};

type Heiles = Hand<HenonHeiles, 2>;

fn begin() -> State<SVector<f64, 2>> {
    State::new([0.1, -0.25], [0.42, 0.1])
}

/// Every scheme makes parts of its step, forwards and backwards, of its own order.
struct Parts;

impl<S: Sample<f64>> Visitor<S> for Parts {
    fn visit<M: Scheme<S>>(&mut self, scheme: M) {
        let entry = scheme.entry();
        let name = (entry.name, entry.variant);
        // Observed as the runs that are saved are: the same code.
        let run = Integrator::new(&S::sample(), scheme, S::begin(), 0.01);
        let mut run = run.unwrap().observe(watchers());
        run.advance(3).unwrap();
        let (third, time, interval) = (run.state().clone(), run.time(), run.duration());
        assert_eq!(run.state_at(time).unwrap(), third);
        for part in [1.0, 0.3, -0.3, -1.0] {
            let t = time + part * interval;
            let state = run.state_at(t).unwrap();
            let step = (t - time) / 8.0;
            let fine = Integrator::new(&S::sample(), RungeKutta4, third.clone(), step);
            let mut fine = fine.unwrap();
            // One step of h = 0.01 of order 1 errs by a few h², one of order 2 by a few h³.
            let size = match entry.name {
                "SymplecticEuler" => 1e-3,
                _ => 3e-5,
            };
            let error = difference(&state, fine.advance(8).unwrap());
            assert!(error < size, "{name:?}, {part} of a step: {error:e}");
            assert_eq!(state.t, t, "{name:?}");
        }
        assert_eq!(run.state(), &third);
        // Beyond a step, or no time at all.
        for t in [time + 1.01 * interval, time - 1.01 * interval, f64::NAN] {
            match run.state_at(t).unwrap_err() {
                Error::Time(TimeError::Far {
                    target, from, to, ..
                }) => {
                    assert!(target.to_bits() == t.to_bits() && from < to, "{name:?}");
                    let reach = 2.0 * interval;
                    assert!((to - from - reach).abs() < 1e-15, "{name:?}");
                }
                other => panic!("{name:?}: {other:?}"),
            }
        }
    }
}

#[test]
fn every_scheme_makes_parts_of_its_step() {
    everywhere(&mut Parts);
}

/// Another step is another run from here: the same bits, and the count goes on.
struct Changes;

impl Visitor<Heiles> for Changes {
    fn visit<M: Scheme<Heiles>>(&mut self, scheme: M) {
        let name = scheme.entry().name;
        let system = Hand(HenonHeiles);
        let mut run = Integrator::new(&system, scheme.clone(), begin(), 0.01).unwrap();
        run.advance(7).unwrap();
        let here = run.state().clone();
        run.change_step(-0.03).unwrap();
        assert_eq!(run.state(), &here, "{name}");
        let mut other = Integrator::new(&system, scheme, here, -0.03).unwrap();
        assert_eq!(
            run.advance(1030).unwrap(),
            other.advance(1030).unwrap(),
            "{name}"
        );
        assert_eq!((run.steps(), run.step()), (1037, -0.03), "{name}");
        for step in [0.0, f64::NAN] {
            assert!(matches!(
                run.change_step(step),
                Err(Error::Start(StartError::Step { .. }))
            ));
        }
        assert_eq!(run.state(), other.state(), "{name}");
    }
}

#[test]
fn the_step_can_be_changed() {
    visit_any(&mut Changes);
    visit_unforced(&mut Changes);
    visit_separable(&mut Changes);
    visit_split(&mut Changes);
    Changes.visit(Srkn6b);
}
