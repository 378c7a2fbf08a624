//! This library on the problems of the comparison with its peers.
//!
//! Prints each problem with its reference, then the results of this library on it, one JSON object a line.
//! References are made in double-double (106 bits) with Gauss's collocation of order 32, and once more with half
//! the step: `uncertainty` is the difference. With a name as argument only that problem is treated.

mod problems;
mod support;

use hamiltonian::Vector;
use hamiltonian::VectorOf;
use hamiltonian::prelude::*;
use hamiltonian::schemes::{BlanesCasasEscorihuela8, Processed6, Srkn11b};
use hamiltonian::{Rounding, Scheme};
use problems::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use support::*;

/// Bodies of the cluster.
const BODIES: usize = 1000;
/// Particles of the ring.
const RING: usize = 1024;
/// Particles of the chain.
const CHAIN: usize = 31;
/// Pendulums of the ensemble.
const PENDULUMS: usize = 1000;
/// The time to which they swing.
const SWING: f64 = 100.0;
/// The end that a scheme is to reach, and its start.
struct Goal<'a, V: Vector, E> {
    problem: &'a str,
    /// Words behind the name of a scheme.
    note: &'a str,
    start: &'a State<V>,
    end: f64,
    /// The error of an end point.
    error: E,
}

/// The results of one scheme, unfused and fused: more and more steps, until the error is that of rounding or
/// runs take too long. It takes `parts` settings to double the steps: more for a scheme of high order, which gains
/// much from few more.
fn race<S: System, M: Scheme<S>>(
    goal: &Goal<VectorOf<S>, impl Fn(&State<VectorOf<S>>) -> f64>,
    system: &S,
    scheme: M,
    (first, parts): (u64, u32),
) {
    let method = format!("{}{}", scheme.entry(), goal.note);
    for fused in [false, true] {
        let mut best = f64::INFINITY;
        for setting in 0..12 * parts {
            let steps = (first as f64 * (setting as f64 / parts as f64).exp2()).round() as u64;
            let begin = || {
                let step = goal.end / steps as f64;
                let run = Integrator::new(system, scheme.clone(), goal.start.clone(), step);
                run.map(|run| if fused { run.fused() } else { run })
            };
            // A step too long to be solved is no result.
            let Ok(run) = begin() else { continue };
            let mut run = run.observe(EnergyDrift::new());
            if run.advance(steps).is_err() {
                continue;
            }
            let error = (goal.error)(run.state());
            let energy = run.observer().max_relative();
            let seconds = time(|| {
                let mut run = begin().expect("it began before");
                let _ = run.advance(steps);
            });
            row(
                goal.problem,
                &method,
                fused,
                &format!("{steps} steps"),
                error,
                Some(energy),
                seconds,
            );
            // Rounding: twice the steps gained nothing more.
            if seconds > 1.0 || error < 1e-15 || error > best && best < 1e-9 {
                break;
            }
            if setting % parts == 0 {
                best = best.min(error);
            }
        }
    }
}

/// A problem: its reference, and the rows of the schemes. `$n` lifts a number to the scalar of the state.
macro_rules! problem {
    ($only:ident, $name:literal, $system:expr, [$($key:literal: $value:expr),*], $rows:expr, $end:expr,
     reference $steps:literal, $n:ident => $start:expr,
     [$($scheme:expr, $first:expr, $parts:literal;)+] $(, $in_time:expr)?) => {
        if $only.as_deref().is_none_or(|only| only == $name) {
            let system = $system;
            let end: f64 = $end;
            let start = {
                let $n = |x: f64| x;
                $start
            };
            let reference = |steps: u64| {
                let $n = |x: f64| DoubleDouble::from(x);
                let step = DoubleDouble::from(end) / DoubleDouble::from(steps as f64);
                let run = Integrator::new(&system, Gauss::<16>::default(), $start, step);
                numbers(run.expect("a good start").advance(steps).expect("good steps"))
            };
            let fine = reference(2 * $steps);
            let coarse = reference($steps);
            let uncertainty = difference(&coarse, &fine);
            describe(&Problem {
                name: $name,
                parameters: &[$(($key, list($value))),*],
                rows: $rows,
                end,
                start: &numbers(&start),
                reference: &fine,
                uncertainty,
            });
            let error = |state: &_| apart(&numbers(state), &fine);
            let goal = Goal { problem: $name, note: "", start: &start, end, error };
            $(race(&goal, &system, $scheme, ($first, $parts));)+
            $(($in_time)(&start, end, &fine[..]);)?
        }
    };
}

/// Numbers in (−1, 1) that are the same everywhere.
fn scattered(count: usize) -> Vec<f64> {
    let mut state = 1_u64;
    let mut next = || {
        // D. E. Knuth's generator MMIX.
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    (0..count).map(|_| next()).collect()
}

/// Sixteen stages of 1024 particles in double-double, on the stack.
const STACK: usize = 1 << 28;

fn main() {
    let thread = std::thread::Builder::new().stack_size(STACK);
    let solving = thread.spawn(solve_all).expect("a thread starts");
    solving.join().expect("every problem is solved");
}

fn solve_all() {
    let only = std::env::args().nth(1);
    problem!(only, "kepler", Kepler {}, [], 2, 1000.0 * TAU, reference 60_000,
        n => State::over([n(0.4), n(0.0)], [n(0.0), n(2.0)]),
        [GaussNystrom::<8>::default(), 15_000, 4; GaussNystrom::<4>::default(), 40_000, 4;
         BlanesCasasEscorihuela8, 20_000, 2; Srkn11b, 40_000, 2; Processed6::default(), 50_000, 2;
         StormerVerlet::default(), 1_000_000, 2;],
        |start: &_, end, exact: &[_]| in_s("kepler", [10_000, 30_000], start, end, exact));
    problem!(only, "encounter", Kepler {}, [], 2, 100.0 * TAU, reference 60_000,
        n => State::over([n(0.1), n(0.0)], [n(0.0), n(19.0).sqrt()]),
        [GaussNystrom::<8>::default(), 10_000, 4; BlanesCasasEscorihuela8, 20_000, 2; Srkn11b, 40_000, 2;
         StormerVerlet::default(), 1_000_000, 2;],
        |start: &_, end, exact: &[_]| in_s("encounter", [1_500, 5_000], start, end, exact));
    problem!(only, "henon_heiles", HenonHeiles {}, [], 2, 1e4, reference 20_000,
        n => State::over([n(0.12), n(0.23)], [n(0.31), n(-0.17)]),
        [GaussNystrom::<8>::default(), 3_000, 4; GaussNystrom::<4>::default(), 10_000, 4;
         BlanesCasasEscorihuela8, 5_000, 2; Srkn11b, 10_000, 2; Processed6::default(), 10_000, 2;
         StormerVerlet::default(), 100_000, 2;]);
    problem!(only, "pendulum", Pendulum {}, [], 1, 1e4, reference 20_000,
        n => State::over([n(1.5)], [n(0.0)]),
        [GaussNystrom::<8>::default(), 3_000, 4; GaussNystrom::<4>::default(), 10_000, 4;
         BlanesCasasEscorihuela8, 5_000, 2; Srkn11b, 10_000, 2; Processed6::default(), 10_000, 2;
         StormerVerlet::default(), 100_000, 2;]);
    problem!(only, "coupled", Coupled {}, [], 1, 1e4, reference 60_000,
        n => State::over([n(-3.0)], [n(0.0)]),
        [Gauss::<8>::default(), 10_000, 4; Gauss::<4>::default(), 40_000, 4; Processed6::default(), 40_000, 2;
         KahanLi8, 20_000, 2; Strang, 400_000, 2;]);
    let masses = PLANETS.map(|(mass, ..)| mass);
    problem!(only, "planets", Planets::new(masses), ["G": [2.95912208286e-4], "m": masses], 6, 365_250.0,
        reference 6_000,
        n => State::over(
            PLANETS.map(|(_, q, _)| q.map(n)),
            PLANETS.map(|(mass, _, v)| v.map(|v| n(mass * v))),
        ),
        [GaussNystrom::<8>::default(), 400, 4; GaussNystrom::<4>::default(), 1_500, 4;
         BlanesCasasEscorihuela8, 300, 2; Srkn11b, 500, 2; Processed6::default(), 500, 2;
         StormerVerlet::default(), 4_000, 2;]);
    problem!(only, "black_hole", BlackHole::default(), ["E": [0.995], "L": [4.6]], 2, 1e4, reference 4_000,
        n => State::over([n(11.0), n(FRAC_PI_2)], [n(0.0), n(2.062_449_325_976_816)]),
        [Gauss::<8>::default(), 200, 4; Gauss::<4>::default(), 500, 4; Processed6::default(), 500, 2;
         KahanLi8, 400, 2; Strang, 10_000, 2;]);
    let wave = |i: usize| {
        0.5 * (TAU * i as f64 / RING as f64).cos()
            + 0.3 * (TAU * 7.0 * i as f64 / RING as f64).sin()
    };
    let waves: [f64; RING] = std::array::from_fn(wave);
    problem!(only, "toda", Toda::<RING> {}, [], RING, 20.0, reference 30,
        n => State::over([n(0.0); RING], waves.map(n)),
        [GaussNystrom::<8>::default(), 10, 4; BlanesCasasEscorihuela8, 2, 2; Srkn11b, 3, 2;
         Processed6::default(), 4, 2; StormerVerlet::default(), 25, 2;]);
    let mode: [f64; CHAIN] =
        std::array::from_fn(|i| (PI * (i + 1) as f64 / (CHAIN + 1) as f64).sin());
    problem!(only, "fput", Fput::<CHAIN>::default(), ["alpha": [0.25]], CHAIN, 1000.0, reference 2_000,
        n => State::over(mode.map(n), [n(0.0); CHAIN]),
        [GaussNystrom::<8>::default(), 300, 4; GaussNystrom::<4>::default(), 1_000, 4;
         BlanesCasasEscorihuela8, 200, 2; Srkn11b, 300, 2; Processed6::default(), 300, 2;
         StormerVerlet::default(), 2_000, 2;]);
    let places = scattered(3 * BODIES);
    let cluster = Cluster::new(BODIES).expect("as many bodies as places");
    problem!(only, "cluster", cluster, ["m": [1e-3], "eps2": [2.5e-3]], BODIES, 0.25, reference 4,
        n => State::over(
            places.chunks(3).map(|q| [n(q[0]), n(q[1]), n(q[2])]).collect::<Vec<_>>(),
            places.chunks(3).map(|q| [n(-1e-3 * q[1]), n(1e-3 * q[0]), n(0.0)]).collect::<Vec<_>>(),
        ),
        [BlanesCasasEscorihuela8, 1, 2; Srkn11b, 2, 2; StormerVerlet::default(), 8, 2;]);
    ensemble(only.as_deref());
}

/// Kepler's problem in the time s, dt = r ds, of which 2π is a period. The error of t counts too.
fn in_s(problem: &str, first: [u64; 2], start: &StateOf<Kepler>, end: f64, exact: &[DoubleDouble]) {
    let system = TimeTransformed::by(Kepler {}, "radius").expect("a monitor of the definition");
    let error = |state: &_| {
        let declared: StateOf<Kepler> = system.declared(state);
        apart(&numbers(&declared), exact).max((declared.t - end).abs())
    };
    let start = &system.start(start).expect("an orbit");
    let goal = Goal {
        problem,
        note: ", dt = r ds",
        start,
        end,
        error,
    };
    race(&goal, &system, Gauss::<8>::default(), (first[0], 4));
    race(&goal, &system, Gauss::<4>::default(), (first[1], 4));
}

/// Pendulums that start apart, in the lanes of packs.
fn ensemble(only: Option<&str>) {
    if only.is_some_and(|only| only != "ensemble") {
        return;
    }
    let start = |k: usize| {
        let at = k as f64 / PENDULUMS as f64;
        (3.0 * at - 1.5, 2.0 * (at - 0.5))
    };
    let reference = |steps: u64| -> Vec<(DoubleDouble, DoubleDouble)> {
        let solve = |k| {
            let (q, p) = start(k);
            let start = State::over([DoubleDouble::from(q)], [DoubleDouble::from(p)]);
            let step = DoubleDouble::from(SWING) / DoubleDouble::from(steps as f64);
            let run = Integrator::new(&Pendulum {}, Gauss::<16>::default(), start, step);
            let mut run = run.expect("a good start");
            let end = run.advance(steps).expect("good steps");
            (end.q[0], end.p[0])
        };
        (0..PENDULUMS).map(solve).collect()
    };
    let exact = reference(256);
    let flat = |ends: &[(DoubleDouble, DoubleDouble)]| -> Vec<DoubleDouble> {
        let (q, p): (Vec<_>, Vec<_>) = ends.iter().copied().unzip();
        [q, p].concat()
    };
    let coarse = flat(&reference(128));
    let exact = flat(&exact);
    let (q, p): (Vec<_>, Vec<_>) = (0..PENDULUMS).map(start).unzip();
    describe(&Problem {
        name: "ensemble",
        parameters: &[],
        rows: PENDULUMS,
        end: SWING,
        start: &[q, p].concat(),
        reference: &exact,
        uncertainty: difference(&coarse, &exact),
    });
    swings(Srkn11b, 100, &start, &exact);
    swings(BlanesCasasEscorihuela8, 50, &start, &exact);
    swings(GaussNystrom::<4>::default(), 50, &start, &exact);
    swings(GaussNystrom::<8>::default(), 25, &start, &exact);
}

/// The results of one scheme for all pendulums, with more and more steps until the error is that of rounding.
fn swings<M: Scheme<Pendulum>>(
    scheme: M,
    first: u64,
    start: impl Fn(usize) -> (f64, f64),
    exact: &[DoubleDouble],
) {
    let method = scheme.entry().to_string();
    for fused in [false, true] {
        let mut best = f64::INFINITY;
        for setting in 0..12 {
            let steps = (first as f64 * (f64::from(setting) / 2.0).exp2()).round() as u64;
            let run = || swing(scheme.clone(), steps, &start, fused);
            // A step too long to be solved is no result.
            let Ok(end) = run() else { continue };
            let error = apart(&end, exact);
            row(
                "ensemble",
                &method,
                fused,
                &format!("{steps} steps"),
                error,
                None,
                time(|| drop(run())),
            );
            if error > best && best < 1e-9 {
                break;
            }
            best = best.min(error);
        }
    }
}

/// All pendulums to the end, on one thread: places, then momenta.
fn swing<M: Scheme<Pendulum>>(
    scheme: M,
    steps: u64,
    start: impl Fn(usize) -> (f64, f64),
    fused: bool,
) -> Result<Vec<f64>, Error> {
    let member = |member: Member| {
        let (q, p) = start(member.index);
        (Pendulum {}, State::new([q], [p]))
    };
    let swarm = Ensemble::new(PENDULUMS, member, scheme, SWING / steps as f64)?.with_threads(1);
    match fused {
        true => ends_of(swarm, steps),
        false => ends_of(swarm.reproducible(), steps),
    }
}

/// The ends of all members: places, then momenta.
fn ends_of<M: Scheme<Pendulum>, A: Rounding>(
    mut swarm: Ensemble<Pendulum, M, (), A>,
    steps: u64,
) -> Result<Vec<f64>, Error> {
    swarm.advance(steps);
    let mut ends = vec![0.0; 2 * PENDULUMS];
    for (k, end) in swarm.states().enumerate() {
        let end = end?;
        (ends[k], ends[PENDULUMS + k]) = (end.q[0], end.p[0]);
    }
    Ok(ends)
}
