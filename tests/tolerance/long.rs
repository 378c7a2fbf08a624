//! Long runs whose steps follow from a tolerance of H.

use super::{Coupled, pendulum};
use crate::common::is_heavy;
use hamiltonian::errors::{Error, StepError};
use hamiltonian::prelude::*;
use hamiltonian::schemes::BlanesMoan6;

/// The error of H stays below the tolerance after the pilot as well, and the step is not much shorter than that needs:
/// with one twice as long, as a negative control, the error is above it.
#[test]
fn the_error_of_the_energy_stays_below_a_tolerance() {
    let n = if is_heavy() { 300_000 } else { 20_000 };
    for tolerance in [1e-5, 1e-8, 1e-11] {
        let drift = |step: f64| {
            let start = State::new([-3.0], [0.0]);
            let mut run = Integrator::new(&Coupled {}, BlanesMoan6, start, step)
                .unwrap()
                .observe(EnergyDrift::new());
            run.advance(n).unwrap();
            run.observer().max_relative()
        };
        let start = State::new([-3.0], [0.0]);
        let run = Integrator::to_tolerance_long(&Coupled {}, start, tolerance).unwrap();
        let step = run.step();
        let [kept, twice] = [step, 2.0 * step].map(drift);
        println!("{tolerance:e}: steps of {step:.4}: {kept:.1e}, of twice that {twice:.1e}");
        assert!(
            kept <= tolerance && kept > tolerance / 20.0,
            "{kept:e} at {tolerance:e}"
        );
        assert!(twice > tolerance, "{twice:e} at {tolerance:e}");
    }
}

#[test]
fn no_step_meets_a_tolerance_below_rounding() {
    let start = State::new([1.5], [0.0]);
    let refused = Integrator::to_tolerance_long(&pendulum(), start.clone(), 1e-18);
    let error = refused.map(|_| ()).unwrap_err();
    assert!(
        matches!(error, Error::Step(StepError::Refused { .. })),
        "{error}"
    );
    let refused = Integrator::to_tolerance_long(&pendulum(), start, -1.0);
    assert!(matches!(refused.map(|_| ()), Err(Error::Start(_))));
    // A point at rest has no error.
    let rest = Integrator::to_tolerance_long(&pendulum(), State::new([0.0], [0.0]), 1e-9);
    assert_eq!(rest.unwrap().advance(10).unwrap().q[0], 0.0);
}
