//! States between two steps: their errors beside those of steps, and what they cost.

use super::{BlackHole, Coupled, Kepler, Restricted, arenstorf, kepler, pendulum};
use hamiltonian::prelude::*;
use hamiltonian::schemes::{Adaptive, ToTolerance};
use std::cell::Cell;

/// The states of `n` steps, and of a third and of two thirds of each, from a run of the scheme at this tolerance.
fn outputs<S>(system: &S, start: &StateOf<S>, tolerance: f64, n: usize) -> Vec<[StateOf<S>; 4]>
where
    S: ToTolerance,
    Adaptive<S::Scheme>: Scheme<S>,
{
    let mut run = Integrator::to_tolerance(system, start.clone(), tolerance).unwrap();
    let mut before = run.state().clone();
    let mut all = Vec::new();
    for _ in 0..n {
        let end = run.advance(1).unwrap().clone();
        let at = |part: f64| run.state_at(before.t + part * (end.t - before.t)).unwrap();
        all.push([before.clone(), at(0.3), at(0.7), end.clone()]);
        before = end;
    }
    all
}

/// The state at `t` by steps a sixteenth as long.
fn exact<S>(system: &S, from: &StateOf<S>, t: f64) -> StateOf<S>
where
    S: ToTolerance,
    S::Scheme: Scheme<S>,
{
    let h = (t - from.t) / 16.0;
    let mut run = Integrator::new(system, S::Scheme::default(), from.clone(), h).unwrap();
    let mut end = run.advance(16).unwrap().clone();
    end.t = t;
    end
}

fn apart<V: Vector<Scalar = f64>>(a: &State<V>, b: &State<V>) -> f64 {
    super::distance(&a.to_vec(), &b.to_vec())
}

/// The largest error of a state between steps is that of steps, to rounding; a cubic through both ends, as a negative
/// control, is far from it.
#[test]
fn states_between_steps_have_the_error_of_steps() {
    fn of<S>(name: &str, system: &S, start: &StateOf<S>)
    where
        S: ToTolerance,
        S::Scheme: Scheme<S>,
        Adaptive<S::Scheme>: Scheme<S>,
    {
        let [mut of_steps, mut between, mut cubic] = [0.0_f64; 3];
        let mut rounding = 0.0_f64;
        for [before, early, late, end] in outputs(system, start, 1e-9, 60) {
            of_steps = of_steps.max(apart(&end, &exact(system, &before, end.t)));
            for state in [early, late] {
                let near = exact(system, &before, state.t);
                between = between.max(apart(&state, &near));
                let (x, h) = ((state.t - before.t) / (end.t - before.t), end.t - before.t);
                let slopes = [&before, &end].map(|state| system.gradient(state).p);
                for (i, value) in near.q.components().enumerate() {
                    let [a, b] = [&before, &end].map(|state| state.q.component(i));
                    let [da, db] = [&slopes[0], &slopes[1]].map(|slope| slope.component(i));
                    let y = 1.0 - x;
                    let middle = (1.0 + 2.0 * x) * y * y * a + (1.0 + 2.0 * y) * x * x * b;
                    let found = middle + h * x * y * (y * da - x * db);
                    cubic = cubic.max((found - value).abs());
                }
                let sizes = near.to_vec().into_iter().map(f64::abs);
                rounding = rounding.max(64.0 * f64::EPSILON * sizes.fold(1.0, f64::max));
            }
        }
        println!("{name}: steps {of_steps:.1e}, between {between:.1e}, cubic {cubic:.1e}");
        assert!(between < 2.0 * of_steps + rounding, "{name}");
        assert!(cubic > 100.0 * (of_steps + rounding), "{name}");
    }
    of("Kepler, e = 0.6", &Kepler {}, &kepler(0.6));
    of("Kepler, e = 0.99", &Kepler {}, &kepler(0.99));
    of("a pendulum", &pendulum(), &State::new([2.5], [0.0]));
    of("(34)", &Coupled {}, &State::new([1.0], [1.0]));
    of("Arenstorf", &Restricted::default(), &arenstorf());
    let start = State::new([11.0, 1.5], [0.0, 2.06]);
    of("a black hole", &BlackHole::default(), &start);
}

thread_local! {
    static CALLS: Cell<u32> = const { Cell::new(0) };
}

/// A cosine that counts its evaluations: of a pack, one for all of its lanes.
#[inline(always)]
fn counted<T: Real>(x: T) -> T {
    CALLS.set(CALLS.get() + 1);
    x.cos()
}

hamiltonian! {
    /// A pendulum that counts the evaluations of its force.
    pub struct Counted {}
    fn u(q) = counted;
    H(q; p) = p^2/2 - u(q)
}

hamiltonian! {
    /// The same with a coupling, so that no part of it is quadratic.
    pub struct CountedCoupled {}
    fn u(q) = counted;
    H(q; p) = p^2*(1 + q^2/10)/2 - u(q)
}

/// A state between steps costs half a step: its iteration begins at the polynomial of the step, and at its nearer end.
#[test]
fn states_between_steps_cost_half_a_step() {
    fn of<S>(system: &S, tolerance: f64)
    where
        S: ToTolerance<Shape = <Counted as System>::Shape>,
        Adaptive<S::Scheme>: Scheme<S>,
    {
        let start = || State::new([1.5], [0.0]);
        let calls = |n: u32| {
            let mut run = Integrator::to_tolerance(system, start(), tolerance).unwrap();
            run.advance(10).unwrap();
            let (t, steps) = (run.time(), run.steps());
            CALLS.set(0);
            for state in run.states_at((1..=n).map(|k| t + 20.0 * f64::from(k) / f64::from(n))) {
                state.unwrap();
            }
            (CALLS.get(), run.steps() - steps)
        };
        let ((alone, steps), (both, _)) = (calls(1), calls(400));
        let of_step = f64::from(alone) / steps as f64;
        let of_state = f64::from(both - alone) / 399.0;
        println!("{tolerance:e}: {of_step:.2} a step, {of_state:.2} a state");
        assert!(of_state < 0.6 * of_step, "{of_state} beside {of_step}");
    }
    for tolerance in [1e-6, 1e-9, 1e-12] {
        of(&Counted {}, tolerance);
        of(&CountedCoupled {}, tolerance);
    }
}

/// A run to a time makes the steps that it makes one by one, and none after the one that passes the time.
#[test]
fn steps_to_a_time_are_those_one_by_one() {
    for e in [0.6, 0.9, 0.999] {
        for k in 0..24 {
            let t = 1e-3 * 1.7_f64.powi(k);
            let new = || Integrator::to_tolerance(&Kepler {}, kepler(e), 1e-9).unwrap();
            let (mut run, mut steps) = (new(), new());
            run.advance_until(t).unwrap();
            while steps.time() < t {
                steps.advance(1).unwrap();
            }
            assert_eq!(run.state(), steps.state(), "e = {e}, t = {t}");
            assert_eq!(run.steps(), steps.steps());
            assert_eq!(run.refused_steps(), steps.refused_steps());
        }
    }
}
