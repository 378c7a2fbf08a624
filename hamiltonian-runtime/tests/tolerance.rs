//! Runs of all definitions to a tolerance.
//!
//! Input: the definitions of the repository, each from several starts. Output: a panic if a run neither reaches its end
//! nor has an error, or ends with a number that is not finite, or has another H after
//! its last step.

use crate::common::{numbers, written_definitions};
use crate::corpus::{SIZE, analysed, values};
use hamiltonian::errors::Error;
use hamiltonian::nalgebra::DVector;
use hamiltonian::{Integrator, State, System};
use hamiltonian_runtime::{Definition, RuntimeSystem};

/// The time of a run in units of its first step, at most 1.
const FIRST_STEPS: f64 = 200.0;

/// The most steps of a run.
const MOST: u64 = 20_000;

/// The end of a run.
fn end(system: &RuntimeSystem, seed: usize) -> Result<(), Error> {
    let mut next = numbers(seed);
    let n = system.degrees_of_freedom();
    let mut vector = || DVector::from_fn(n, |_, _| 2.0 * next() - 1.0);
    let start = State {
        t: 0.0,
        q: vector(),
        p: vector(),
    };
    let initial = start.clone();
    let mut run = Integrator::to_tolerance(system, start, 1e-8)?;
    let time = 1.0_f64.min(FIRST_STEPS * run.step());
    while run.state().t < time {
        assert!(run.steps() < MOST, "{run:?}");
        run.advance(1)?;
    }
    let state = run.state_at(time)?;
    assert_eq!(state.t, time);
    assert!(state.to_vec().iter().all(|x| x.is_finite()), "{state:?}");
    let of = system.description();
    if of.is_autonomous && !of.is_forced {
        let [before, after] = [&initial, run.state()].map(|state| system.energy(state));
        let error = (after - before).abs();
        assert!(
            error <= 1e-5 * (1.0 + before.abs()),
            "{}: H is {before}, then {after}",
            of.formula
        );
    }
    Ok(())
}

/// Runs of definitions at random reach their end or have an error with a reason.
#[test]
fn a_tolerance_leads_to_the_end_or_to_an_error() {
    let is_heavy = std::env::var_os("HAMILTONIAN_HEAVY").is_some_and(|value| value == "1");
    let wanted = if is_heavy { 1000 } else { 30 };
    let definitions = written_definitions();
    let mut order: Vec<usize> = (0..definitions.len()).collect();
    let mut next = numbers(11);
    let [mut reached, mut failed] = [0, 0];
    let mut round = 0;
    while reached + failed < wanted {
        // Every definition once in each round, from other starts.
        for i in 0..order.len() {
            let j = i + ((next() - 0.5) * (order.len() - i) as f64) as usize;
            let last = order.len() - 1;
            order.swap(i, j.min(last));
        }
        for &which in &order {
            let text = &definitions[which];
            let (Ok(definition), Some(due)) = (Definition::parse(text, "text"), analysed(text))
            else {
                continue;
            };
            let Ok(system) = definition.system(values(&due, SIZE)) else {
                continue;
            };
            match end(&system, 17 + round) {
                Ok(()) => reached += 1,
                Err(error) => {
                    println!("{}: {error}", system.description().name);
                    assert!(!error.to_string().is_empty());
                    failed += 1;
                }
            }
            if reached + failed == wanted {
                break;
            }
        }
        round += 1;
    }
    println!("{reached} reached their end, {failed} have an error");
    // An error is the exception.
    assert!(failed * 3 < reached, "{failed} of {}", reached + failed);
}
