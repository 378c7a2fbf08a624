//! Runs to a tolerance: what their errors are, that varying steps do not drift, and what is refused.

mod between;
mod jumps;
mod long;

use crate::allocator::allocations;
use crate::common::is_heavy;
use hamiltonian::errors::{Error, StartError, StepError};
use hamiltonian::lanes::DoubleDouble;
use hamiltonian::nalgebra::SVector;
use hamiltonian::prelude::*;
use hamiltonian::schemes::author::Listed;
use hamiltonian::schemes::{Adaptive, Density, Paced, ToTolerance, Tolerance};
use std::f64::consts::TAU;

hamiltonian! {
    /// Kepler's problem.
    pub struct Kepler {}
    H(q[2]; p[2]) = (p[0]^2 + p[1]^2)/2 - 1/sqrt(q[0]^2 + q[1]^2)
}

hamiltonian! {
    /// An oscillator: harmonic, quartic, a pendulum, and mixtures of them.
    pub struct Oscillator { harmonic = 0.0, quartic = 0.0, gravity = 0.0 }
    H(q; p) = p^2/2 + harmonic*q^2/2 + quartic*q^4/4 - gravity*cos(q)
}

hamiltonian! {
    /// The paper's (34).
    pub struct Coupled {}
    H(q; p) = (q^2 + 1)*(p^2 + 1)/2
}

hamiltonian! {
    /// The restricted three-body problem, in the rotating frame.
    pub struct Restricted { mu = 0.012277471 }
    H(x, y; px, py) = (px^2 + py^2)/2 + y*px - x*py - (1 - mu)/sqrt((x + mu)^2 + y^2) - mu/sqrt((x - 1 + mu)^2 + y^2)
}

hamiltonian! {
    /// An oscillator with friction.
    pub struct Damped {}
    H(q; p) = p^2/2 + q^2/2;
    force(q; p) = -p/10
}

/// Kepler's problem at the pericentre of an orbit with a = 1; at the apocentre for negative e.
fn kepler(e: f64) -> StateOf<Kepler> {
    State::new([1.0 - e, 0.0], [0.0, ((1.0 + e) / (1.0 - e)).sqrt()])
}

/// Arenstorf's orbit, which closes after this time (Hairer, Nørsett, Wanner 1993, II.0).
const ARENSTORF: f64 = 17.065_216_560_157_963;

fn arenstorf() -> StateOf<Restricted> {
    // p = v + (−y, x).
    State::new([0.994, 0.0], [0.0, 0.994 - 2.001_585_106_379_082_5])
}

fn pendulum() -> Oscillator {
    let gravity = 1.0;
    Oscillator {
        gravity,
        ..Oscillator::default()
    }
}

fn quartic() -> Oscillator {
    let quartic = 1.0;
    Oscillator {
        quartic,
        ..Oscillator::default()
    }
}

/// The end of a run from these numbers, to a tolerance.
type End = Box<dyn Fn(&[f64], f64) -> Vec<f64>>;

/// A problem to an end, as the tests see all of them.
struct Problem {
    name: String,
    size: f64,
    end: End,
    exact: Box<dyn Fn() -> Vec<f64>>,
    start: Vec<f64>,
}

fn problem<S>(name: &str, system: S, start: StateOf<S>, t: f64) -> Problem
where
    S: ToTolerance + Clone + 'static,
    Adaptive<S::Scheme>: Scheme<S>,
    StateOf<S>: 'static,
{
    let shape = start.q.clone();
    let values = start.to_vec();
    let beside = system.clone();
    let exact = move || {
        // In double-double arithmetic, at a tolerance that f64 does not have.
        let mut wide = State {
            t: DoubleDouble::from(0.0),
            q: beside.zeros::<DoubleDouble>(),
            p: beside.zeros::<DoubleDouble>(),
        };
        for i in 0..start.q.len() {
            *wide.q.component_mut(i) = start.q.component(i).into();
            *wide.p.component_mut(i) = start.p.component(i).into();
        }
        let scheme = Adaptive::new(S::Scheme::default(), 1e-17);
        let mut run = Integrator::new(&beside, scheme, wide, DoubleDouble::from(1.0)).unwrap();
        let end = run.advance_until(t.into()).unwrap();
        end.to_vec().into_iter().map(|x| x.hi()).collect()
    };
    let end = move |values: &[f64], tolerance: f64| {
        let start = State::from_slice(&shape, values).unwrap();
        let mut run = Integrator::to_tolerance(&system, start, tolerance).unwrap();
        run.advance_until(t).unwrap().to_vec()
    };
    let size = values.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    Problem {
        name: name.into(),
        size,
        end: Box::new(end),
        exact: Box::new(exact),
        start: values,
    }
}

fn problems() -> Vec<Problem> {
    let mut all = Vec::new();
    for e in [0.0, 0.3, 0.6, 0.9, 0.99, -0.6, -0.9, -0.99] {
        all.push(problem(
            &format!("Kepler, e = {e}"),
            Kepler {},
            kepler(e),
            4.3 * TAU,
        ));
    }
    let oscillator = |harmonic, quartic, gravity| Oscillator {
        harmonic,
        quartic,
        gravity,
    };
    for (system, q, p) in [
        (oscillator(1.0, 0.0, 0.0), 1.0, 0.0),
        (oscillator(0.0, 1.0, 0.0), 1.0, 0.0),
        (oscillator(0.0, 1.0, 0.0), 0.0, 30.0),
        (oscillator(0.0, 0.0, 1.0), 2.5, 0.0),
        (oscillator(0.0, 0.0, 1.0), 3.1, 0.01),
        (oscillator(0.0, 0.0, 1.0), 0.0, 2.5),
        (oscillator(-1.0, 1.0, 0.0), 0.01, 0.0),
    ] {
        let name = format!("{system:?} from {q}, {p}");
        all.push(problem(&name, system, State::new([q], [p]), 30.0));
    }
    for (q, p) in [(1.0, 1.0), (0.0, 0.3), (3.0, 0.0)] {
        all.push(problem(
            &format!("(34) from {q}, {p}"),
            Coupled {},
            State::new([q], [p]),
            20.0,
        ));
    }
    all.push(problem(
        "Arenstorf",
        Restricted::default(),
        arenstorf(),
        0.9 * ARENSTORF,
    ));
    all.push(problem(
        "a friction",
        Damped {},
        State::new([1.0], [0.0]),
        20.0,
    ));
    all
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
}

/// The error of an end is at most 100 × tolerance × condition number. The condition number is the largest change of the
/// end for a change of the start, by differences.
#[test]
fn errors_follow_tolerances() {
    let mut separated = 0_usize;
    // Some of the problems stand for all of them.
    let (skipped, every, least) = if is_heavy() { (0, 1, 8) } else { (3, 8, 1) };
    for Problem {
        name,
        size,
        end,
        exact,
        start,
    } in problems().into_iter().skip(skipped).step_by(every)
    {
        let exact = exact();
        let condition = (0..start.len())
            .map(|i| {
                let by = 1e-6 * size;
                let [more, less] = [by, -by].map(|by| {
                    let mut start = start.clone();
                    start[i] += by;
                    end(&start, 1e-13)
                });
                distance(&more, &less) / (2.0 * by)
            })
            .fold(1.0, f64::max);
        let largest = exact
            .iter()
            .chain(&start)
            .fold(0.0, |most: f64, x| most.max(x.abs()));
        for tolerance in [1e-4, 1e-7, 1e-10, 1e-13] {
            let error = distance(&end(&start, tolerance), &exact) / largest;
            let bound = 100.0 * tolerance * condition;
            println!(
                "{name}: {tolerance:e}: {error:.1e}, {:.1e} of the bound",
                error / bound
            );
            assert!(
                error <= bound,
                "{name} at {tolerance:e}: {error:e} above {bound:e}"
            );
            separated += usize::from(tolerance == 1e-4 && error > 100.0 * 1e-13 * condition);
        }
    }
    // The bounds tell runs of other tolerances.
    assert!(separated >= least, "{separated}");
}

/// The largest |ΔH| of each tenth of n steps.
fn tenths<S: System>(
    system: &S,
    n: u64,
    energy: f64,
    mut step: impl FnMut() -> StateOf<S>,
) -> Vec<f64> {
    (0..10)
        .map(|_| {
            (0..n / 10).fold(0.0, |most: f64, _| {
                most.max((system.energy(&step()) - energy).abs())
            })
        })
        .collect()
}

/// Reversible steps of varying length keep H; steps by a function of the point before them, as a negative control, do
/// not.
#[test]
fn varying_steps_do_not_drift() {
    let n = if is_heavy() { 10_000_000 } else { 8_000 };
    let energy = Kepler {}.energy(&kepler(0.9));
    let mut run = Integrator::to_tolerance(&Kepler {}, kepler(0.9), 1e-7).unwrap();
    let mut steps = || run.advance(1).unwrap().clone();
    let kept = tenths(&Kepler {}, n, energy, &mut steps);
    let refused = run.refused_steps();
    println!("{kept:?}, {refused} refused");
    assert!(kept[9] < 3.0 * kept[1] && kept[1] > 1e-13, "{kept:?}");

    let mut run =
        Integrator::new(&Kepler {}, GaussNystrom::<2>::default(), kepler(0.9), 1e-2).unwrap();
    let mut steps = || {
        let q = run.state().q;
        run.change_step(0.2 * (q[0] * q[0] + q[1] * q[1]).powf(0.75))
            .unwrap();
        run.advance(1).unwrap().clone()
    };
    let drifted = tenths(&Kepler {}, n, energy, &mut steps);
    println!("negative control: {drifted:?}");
    assert!(drifted[9] > 3.0 * drifted[1], "{drifted:?}");
}

/// The density of steps of an oscillator with the restoring force q³: √(1 + 3q²).
#[derive(Debug, Clone)]
struct Stiffness;

impl Density<Oscillator> for Stiffness {
    fn rate<T: Real>(
        &self,
        _: T,
        q: &SVector<T, 1>,
        _: &SVector<T, 1>,
        dq: &SVector<T, 1>,
        _: &SVector<T, 1>,
    ) -> T {
        let three = T::constant(3.0, 0.0);
        three * q[0] * dq[0] / (T::one() + three * q[0] * q[0])
    }
}

/// Reversible steps of varying length on an anharmonic oscillator: the error of H is the random walk of its rounding. Steps
/// by the same density at the point before them, as a negative control, drift.
#[test]
fn varying_steps_of_an_oscillator_stay_at_rounding() {
    let n = if is_heavy() { 10_000_000 } else { 20_000 };
    let start = || State::new([10.0], [0.0]);
    let energy = quartic().energy(&start());
    let scheme = Paced::new(BlanesMoan6, Stiffness);
    let mut run = Integrator::new(&quartic(), scheme, start(), 3e-4).unwrap();
    let mut sizes = [f64::INFINITY, 0.0_f64];
    let kept = tenths(&quartic(), n, energy, || {
        let before = run.time();
        let state = run.advance(1).unwrap().clone();
        let size = run.time() - before;
        sizes = [sizes[0].min(size), sizes[1].max(size)];
        state
    });
    println!("{kept:?}, steps of {sizes:?}");
    assert!(sizes[1] > 10.0 * sizes[0], "{sizes:?}");
    // Each step rounds numbers that change H by its own rounding.
    let walk = (n as f64).sqrt() * f64::EPSILON * energy;
    assert!(kept[9] < 4.0 * walk, "{kept:?} beside {walk:e}");

    let scheme = GaussNystrom::<2>::default();
    let mut run = Integrator::new(&quartic(), scheme, start(), 1e-3).unwrap();
    let drifted = tenths(&quartic(), n.min(100_000), energy, || {
        let q = run.state().q[0];
        run.change_step(0.01 / (1.0 + 3.0 * q * q).sqrt()).unwrap();
        run.advance(1).unwrap().clone()
    });
    println!("negative control: {drifted:?}");
    assert!(drifted[9] > 3.0 * drifted[1], "{drifted:?}");
}

/// Constant steps are those of the scheme: the error of H stays that of rounding.
#[test]
fn constant_steps_keep_the_energy() {
    let n = if is_heavy() { 10_000_000 } else { 10_000 };
    let start = State::new([1.0], [0.0]);
    let mut run = Integrator::to_tolerance(&quartic(), start.clone(), 1e-13).unwrap();
    run.advance(100).unwrap();
    let step = run.state().t / 100.0;
    let kept = tenths(&quartic(), n, quartic().energy(&start), || {
        run.advance(1).unwrap().clone()
    });
    let duration = run.state().t / run.steps() as f64;
    println!(
        "{kept:?}, steps of {step} and {duration}, {} refused",
        run.refused_steps()
    );
    // Each made the steps a tenth smaller at least; after more of them, a pilot would have chosen anew.
    assert!(run.refused_steps() <= 8);
    // A random walk of roundings of H, which is 1/4.
    let walk = (n as f64).sqrt() * f64::EPSILON;
    assert!(kept[9] < 4.0 * walk, "{kept:?} beside {walk:e}");
}

hamiltonian! {
    /// Atoms on a line between walls, which repel each other.
    pub struct Gas {}
    H(q[3]; p[3]) = (p[0]^2 + p[1]^2 + p[2]^2)/2 + (q[0]^2 + q[1]^2 + q[2]^2)/2 + 1/(q[1] - q[0])^6 + 1/(q[2] - q[1])^6
}

/// Steps that became short in a collision grow again, and the number of pilots that lengthen them is that of doublings.
#[test]
fn steps_grow_again_after_a_collision() {
    // Two atoms overlap.
    let start = || State::new([-1.0, -0.97, 3.0], [0.0; 3]);
    let new = || Integrator::to_tolerance(&Gas {}, start(), 1e-9).unwrap();
    let mut run = new();
    let first = run.step();
    run.advance(500).unwrap();
    let before = run.state().t;
    run.advance(100).unwrap();
    let later = (run.state().t - before) / 100.0;
    println!("{first:e}, {later:e}, {run:?}");
    assert!(later > 20.0 * first, "{later:e} after {first:e}");
    // The same bits for all parts of a run, and with stages one by one.
    let mut parts = new().with_lanes(false);
    for n in [1, 30, 2, 7, 60, 500] {
        parts.advance(n).unwrap();
    }
    assert_eq!(parts.state(), run.state());
    assert_eq!(parts.refused_steps(), run.refused_steps());
}

#[test]
fn the_structure_names_the_scheme() {
    fn of<S: ToTolerance>(_: &S) -> String {
        S::Scheme::default().entry().to_string()
    }
    assert_eq!(of(&Kepler {}), "GaussNystrom (8 stages)");
    assert_eq!(of(&Coupled {}), "Gauss (8 stages)");
    assert_eq!(of(&Restricted::default()), "Gauss (8 stages)");
    assert_eq!(of(&Damped {}), "Gauss (8 stages)");
}

/// A run says what was chosen for it.
#[test]
fn a_run_shows_its_choice() {
    let constant = Integrator::to_tolerance(&pendulum(), State::new([1.5], [0.0]), 1e-9).unwrap();
    let text = format!("{constant:?}");
    for part in ["GaussNystrom", "relative: 1e-9", "sizes: \"constant\""] {
        assert!(text.contains(part), "{text}");
    }
    // The step parameter is the size.
    assert!(
        text.contains(&format!("duration: {:?}", constant.step())),
        "{text}"
    );
    let varying = Integrator::to_tolerance(&Kepler {}, kepler(0.9), 1e-9).unwrap();
    let text = format!("{varying:?}");
    assert!(text.contains("sizes: \"varying\""), "{text}");
}

/// The bits depend on neither blocks, nor observers, nor a saved run in between.
#[test]
fn the_same_run_has_the_same_bits() {
    let new = || Integrator::to_tolerance(&Kepler {}, kepler(0.9), 1e-9).unwrap();
    let mut whole = new();
    let end = whole.advance(300).unwrap().clone();
    let mut parts = new().observe(EnergyDrift::new());
    for n in [1, 2, 97, 150, 50] {
        parts.advance(n).unwrap();
    }
    assert_eq!(parts.state(), &end);
    let mut first = new();
    let saved = first
        .advance(123)
        .map(|_| ())
        .map(|()| first.checkpoint())
        .unwrap();
    let scheme = Adaptive::new(GaussNystrom::<8>::default(), 1e-9);
    let mut resumed = Integrator::resume(&Kepler {}, scheme, saved).unwrap();
    assert_eq!(resumed.advance(177).unwrap(), &end);
    assert_eq!(resumed.refused_steps(), whole.refused_steps());
    // Nothing allocates in steps.
    assert_eq!(allocations(|| drop(whole.advance(300).map(|_| ()))), 0);
}

hamiltonian! {
    /// An orbit round a black hole. A number that is prepared for a branch that is not taken is NaN.
    pub struct BlackHole { E = 0.995, L = 4.6 }
    H(r, theta; p_r, p_theta) = (1 - 2/r)*p_r^2/2 + p_theta^2/(2*r^2) - E^2/(2*(1 - 2/r)) + L^2/(2*r^2*sin(theta)^2)
}

/// A prepared system equals itself, so that its copy in lanes is kept from step to step.
#[test]
fn a_system_in_lanes_is_kept() {
    let system = BlackHole::default();
    let [same, other] = [4.6, 4.7].map(|l| System::prepare::<f64>(&BlackHole { L: l, ..system }));
    let prepared = System::prepare::<f64>(&system);
    let equals = |other| BlackHole::<f64>::equals(&prepared, other);
    assert!(equals(&same) && !equals(&other));
    let start = State::new([11.0, 1.5], [0.0, 2.06]);
    let mut run = Integrator::to_tolerance(&system, start, 1e-9).unwrap();
    run.advance(2).unwrap();
    assert_eq!(allocations(|| drop(run.advance(4).map(|_| ()))), 0);
}

/// Stages in lanes, where several steps are made at a time, have the bits of stages one by one, also where a step is
/// refused; so have parts of a run.
#[test]
fn lanes_do_not_matter() {
    fn of<S>(system: &S, start: StateOf<S>, tolerance: f64, n: u64)
    where
        S: ToTolerance,
        Adaptive<S::Scheme>: Scheme<S>,
    {
        let new = || Integrator::to_tolerance(system, start.clone(), tolerance).unwrap();
        let mut lanes = new();
        let end = lanes.advance(n).unwrap().clone();
        let mut apart = new().with_lanes(false);
        assert_eq!(apart.advance(n).unwrap(), &end);
        let mut parts = new();
        for _ in 0..n {
            parts.advance(1).unwrap();
        }
        assert_eq!(parts.state(), &end);
        assert_eq!(lanes.refused_steps(), apart.refused_steps());
        println!("{} refused", lanes.refused_steps());
    }
    of(&pendulum(), State::new([1.5], [0.0]), 1e-9, 200);
    of(&Kepler {}, kepler(0.6), 1e-11, 200);
    of(&Kepler {}, kepler(-0.9), 1e-9, 200);
    of(&Coupled {}, State::new([-3.0], [0.0]), 1e-9, 200);
    of(&Restricted::default(), arenstorf(), 1e-9, 200);
}

/// A run whose parameters were changed has those of a new run, in every step.
#[test]
fn changed_parameters_hold_in_all_steps() {
    let start = State::new([2.5], [0.0]);
    let [light, heavy] = [1.0, 2.0].map(|gravity| Oscillator {
        gravity,
        ..Oscillator::default()
    });
    let scheme = Adaptive::new(GaussNystrom::<8>::default(), 1e-9);
    // The parameter is no first step, so that each step is resized.
    let mut changed = Integrator::new(&light, scheme, start.clone(), 1.0).unwrap();
    changed.advance(5).unwrap();
    changed.set_system(&heavy).unwrap();
    let now = changed.state().clone();
    let mut new = Integrator::new(&heavy, scheme, now, 1.0).unwrap();
    assert_eq!(changed.advance(20).unwrap(), new.advance(20).unwrap());
    // And one whose direction was.
    let back = |run: &mut Run<Oscillator, Adaptive<GaussNystrom<8>>>| {
        run.change_step(-1.0).unwrap();
        run.advance(20).unwrap().clone()
    };
    let now = changed.state().clone();
    let mut new = Integrator::new(&heavy, scheme, now, -1.0).unwrap();
    assert_eq!(&back(&mut changed), new.advance(20).unwrap());
}

/// States between steps, and backwards.
#[test]
fn any_time_in_both_directions() {
    let system = pendulum();
    let start = State::new([2.5], [0.0]);
    let fine = |t: f64| {
        let mut run = Integrator::to_tolerance(&system, start.clone(), 1e-14).unwrap();
        run.advance_until(t).unwrap()
    };
    for sign in [1.0, -1.0] {
        let scheme = Adaptive::new(GaussNystrom::<8>::default(), 1e-11);
        let mut run = Integrator::new(&system, scheme, start.clone(), sign).unwrap();
        for state in run.states_at([0.01, 0.5, 0.77, 3.0, 3.1].map(|t| sign * t)) {
            let state = state.unwrap();
            // q is even and p odd in t.
            let exact = fine(state.t.abs());
            let errors = [state.q[0] - exact.q[0], state.p[0] - sign * exact.p[0]];
            assert!(
                errors.iter().all(|x| x.abs() < 1e-9),
                "{errors:?} at {}",
                state.t
            );
        }
    }
}

/// Derivatives by the start are those of the orbit: sizes of steps have none.
#[test]
fn derivatives_by_the_start() {
    let system = pendulum();
    let end = |q: f64| {
        let mut run = Integrator::to_tolerance(&system, State::new([q], [0.0]), 1e-13).unwrap();
        run.advance_until(7.0).unwrap().q[0]
    };
    let by = 1e-4;
    let difference = (end(2.0 + by) - end(2.0 - by)) / (2.0 * by);
    let start = State::over([Dual::variable(2.0)], [Dual::fixed(0.0)]);
    let mut run = Integrator::to_tolerance(&system, start, 1e-13).unwrap();
    let found = run.advance_until(Dual::fixed(7.0)).unwrap().q[0];
    assert!(
        (found.eps / difference - 1.0).abs() < 1e-6,
        "{} {difference}",
        found.eps
    );
}

#[test]
fn what_no_step_can_meet_is_refused() {
    let with = |tolerance: Tolerance| {
        Integrator::to_tolerance(&Kepler {}, kepler(0.5), tolerance).unwrap_err()
    };
    for relative in [0.0, -1e-6, f64::NAN, f64::INFINITY] {
        let error = with(relative.into());
        assert!(
            matches!(error, Error::Start(StartError::Tolerance { .. })),
            "{error}"
        );
    }
    let error = with(Tolerance {
        relative: 1e-6,
        absolute: -1.0,
    });
    assert_eq!(
        error.to_string(),
        "a tolerance must be positive and finite, found 1e-6 relative and -1 absolute"
    );
    // A fall into the centre.
    let start = State::new([1.0, 0.0], [0.0, 0.0]);
    let mut run = Integrator::to_tolerance(&Kepler {}, start, 1e-9).unwrap();
    let error = run.advance_until(10.0).unwrap_err();
    assert!(
        matches!(error, Error::Step(StepError::Refused { .. })),
        "{error}"
    );
    // t = π/(2√2).
    assert!(
        (run.time() - 1.110_720_734_539_592).abs() < 1e-6,
        "{}",
        run.time()
    );
    println!("{error}");
}
