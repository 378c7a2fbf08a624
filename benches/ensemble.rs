//! An ensemble of pendulums, Störmer–Verlet, on the code that `hamiltonian!` emits: every level of
//! this CPU against scalar loops, in one process.
//!
//! `cargo bench --bench ensemble` prints million trajectory-steps a second and how many times that
//! is the loop one writes with the standard library's sine, trajectory by trajectory: the best of
//! many short alternating rounds, which other programs seldom interrupt. With `-- --json` it prints
//! one line a level; with `-- --check` it fails where a level is below what it is held to, 25 times
//! on AVX-512 and 12 times on AVX2. Before anything is timed, the ends of all trajectories are
//! compared with those of single runs: the same bits where nothing fuses.
//!
//! After them members are timed against scalar runs for implicit schemes, for many stages, and for steps that
//! each have a size of their own.
//!
//! The loop over 100 trajectories at a time shows how much of the gain is overlap alone: there the
//! processor works on several sines at once, in the other one each step waits for the last.

use std::hint::black_box;
use std::time::{Duration, Instant};

use hamiltonian::VectorOf;
use hamiltonian::prelude::*;
use hamiltonian::{
    Scheme, System, Vector,
    schemes::author::{Carried, Clock, Map, Scratch, Step},
};
use hamiltonian_lanes::{Cpu, Kernel, Level, Nf, Pack, dispatch_at_most};

hamiltonian! {
    /// A planar pendulum.
    pub struct Pendulum { m = 1.0, l = 10.0, g = 9.81 }
    H(q; p) = p^2/(2*m*l^2) - m*g*l*cos(q)
}

/// Trajectories: 15 blocks of 64 lanes and a remainder.
const COUNT: usize = 1000;
const STEP: f64 = 1e-3;

/// All trajectories, structure of arrays.
#[derive(Clone, PartialEq, Debug)]
struct States {
    q: Vec<f64>,
    p: Vec<f64>,
}

fn starts() -> States {
    let at = |k: usize| k as f64 / COUNT as f64;
    States {
        q: (0..COUNT).map(|k| 3.0 * at(k) - 1.5).collect(),
        p: (0..COUNT).map(|k| 20.0 * (at(k) - 0.5)).collect(),
    }
}

/// `n` steps of all trajectories in the lanes of a pack, by the scheme's own map: a block stays in
/// registers for all steps.
#[inline(always)]
fn steps<T: Pack>(system: &Pendulum, states: &mut States, n: u64) {
    let h = T::constant(STEP, 0.0);
    let prepared = <Pendulum as System>::prepare::<T>(system);
    let scheme = StormerVerlet::default();
    let map = Scheme::<Pendulum>::prepare(&scheme, &prepared, Step::of(h));
    let clock = Clock::new(T::zero(), h);
    let lanes = T::LANES as usize;
    for (some_q, some_p) in states.q.chunks_mut(lanes).zip(states.p.chunks_mut(lanes)) {
        let start = State::over([T::load(some_q, 0.0)], [T::load(some_p, 0.0)]);
        let mut carried = Scheme::<Pendulum>::start(&scheme, &prepared, &start, h);
        // The scratch of a splitting is nothing.
        #[allow(clippy::let_unit_value)]
        let mut work = Scratch::like(&carried);
        map.run(clock, 0, n, &mut carried, &mut work);
        map.close(clock.at(n), &mut carried, &mut work);
        let point = carried.point();
        point.q[0].store(some_q);
        point.p[0].store(some_p);
    }
}

/// The same on a level, with its own products or unfused.
struct Steps<'a> {
    system: &'a Pendulum,
    states: &'a mut States,
    n: u64,
    unfused: bool,
}

impl Kernel for Steps<'_> {
    type Output = ();
    #[inline(always)]
    fn run<L: Level>(self) {
        if self.unfused {
            steps::<Nf<L::Wide>>(self.system, self.states, self.n);
        } else {
            steps::<L::Wide>(self.system, self.states, self.n);
        }
    }
}

/// The loop one writes by hand with the standard library, `block` trajectories at a time.
#[inline(never)]
fn by_hand(system: &Pendulum, states: &mut States, n: u64, block: usize) {
    let Pendulum { m, l, g } = *system;
    let (kick, drift) = (STEP * (m * g * l), STEP / (m * l * l));
    for (q, p) in states.q.chunks_mut(block).zip(states.p.chunks_mut(block)) {
        for (q, p) in q.iter_mut().zip(&mut *p) {
            *p -= 0.5 * kick * q.sin();
            *q += drift * *p;
        }
        for _ in 1..n {
            for (q, p) in q.iter_mut().zip(&mut *p) {
                *p -= kick * q.sin();
                *q += drift * *p;
            }
        }
        for (q, p) in q.iter_mut().zip(p) {
            *p -= 0.5 * kick * q.sin();
        }
    }
}

/// Single runs of the library, one after the other.
fn singly(system: &Pendulum, states: &mut States, n: u64) {
    for (q, p) in states.q.iter_mut().zip(&mut states.p) {
        let start = State::new([*q], [*p]);
        let mut run = Integrator::new(system, StormerVerlet::default(), start, STEP)
            .expect("the starts are finite");
        let end = run.advance(n).expect("the pendulum stays finite");
        (*q, *p) = (end.q[0], end.p[0]);
    }
}

/// The largest difference of two ensembles.
fn distance(a: &States, b: &States) -> f64 {
    let pairs = a.q.iter().zip(&b.q).chain(a.p.iter().zip(&b.p));
    pairs.fold(0.0, |largest, (a, b)| {
        let difference = (a - b).abs();
        if difference > largest || difference.is_nan() {
            difference
        } else {
            largest
        }
    })
}

/// The ratio to the scalar loop that a level must reach.
fn target(cpu: Cpu) -> f64 {
    match cpu {
        Cpu::Avx512 => 25.0,
        Cpu::Avx2 => 12.0,
        _ => 0.0,
    }
}

fn main() {
    let (mut check, mut json) = (false, false);
    for argument in std::env::args() {
        check |= argument == "--check";
        json |= argument == "--json";
    }
    let system = black_box(Pendulum::default());
    let levels: Vec<Cpu> = Cpu::available().collect();

    let mut expected = starts();
    singly(&system, &mut expected, 300);
    for &cpu in &levels {
        for unfused in [true, false] {
            let mut states = starts();
            dispatch_at_most(
                cpu,
                Steps {
                    system: &system,
                    states: &mut states,
                    n: 300,
                    unfused,
                },
            );
            let apart = distance(&states, &expected);
            // Roundings of 300 steps; momenta are below 32.
            let allowed = if unfused {
                0.0
            } else {
                300.0 * 32.0 * f64::EPSILON
            };
            assert!(
                apart <= allowed,
                "{cpu:?}, unfused {unfused}: {apart:e} from single runs"
            );
        }
    }

    type Run = Box<dyn Fn(&Pendulum, &mut States, u64)>;
    let mut runs: Vec<(String, f64, Run)> = vec![];
    for block in [1, 100] {
        runs.push((
            format!("std, {block} at a time"),
            0.0,
            Box::new(move |system, states, n| by_hand(system, states, n, block)),
        ));
    }
    runs.push(("single runs".into(), 0.0, Box::new(singly)));
    for cpu in levels {
        for unfused in [false, true] {
            let name = format!("{cpu:?}{}", if unfused { ", unfused" } else { "" });
            let run = move |system: &Pendulum, states: &mut States, n| {
                dispatch_at_most(
                    cpu,
                    Steps {
                        system,
                        states,
                        n,
                        unfused,
                    },
                );
            };
            let target = if unfused { 0.0 } else { target(cpu) };
            runs.push((name, target, Box::new(run)));
        }
    }

    let n = 60;
    let mut best = vec![Duration::MAX; runs.len()];
    for _ in 0..100 {
        for ((_, _, run), best) in runs.iter().zip(&mut best) {
            let mut states = starts();
            let start = Instant::now();
            run(&system, black_box(&mut states), black_box(n));
            *best = start.elapsed().min(*best);
            black_box(&states);
        }
    }
    let rate = |time: Duration| (COUNT as u64 * n) as f64 / time.as_secs_f64() / 1e6;
    let by_hand = rate(best[0]);
    let mut failed = false;
    for ((name, target, _), best) in runs.iter().zip(&best) {
        let ratio = rate(*best) / by_hand;
        if json {
            println!("{{\"workload\":\"ensemble of pendulums, {name}\",\"ratio\":{ratio:.2}}}");
        } else {
            println!("{name:<24} {:>9.1} M steps/s {ratio:>8.2} ×", rate(*best));
        }
        if check && ratio < *target {
            failed = true;
            println!("FAILED {name}: {ratio:.2} times the loop by hand, not {target}");
        }
    }
    if !json {
        println!("\nMembers of an ensemble, reproducible, against a scalar run:");
        members(ImplicitMidpoint::default());
        members(Gauss::<2>::default());
        members(Gauss::<4>::default());
        members(GaussNystrom::<4>::default());
        members(BlanesMoan6);
        members(Paced::new(BlanesMoan6, Swing));
    }
    std::process::exit(i32::from(failed));
}

/// Steps that are smaller where the pendulum swings fast.
#[derive(Debug, Clone, PartialEq)]
struct Swing;

impl<S: System> Density<S> for Swing {
    #[inline(always)]
    fn rate<T: Real>(
        &self,
        _: T,
        q: &VectorOf<S, T>,
        _: &VectorOf<S, T>,
        dq: &VectorOf<S, T>,
        _: &VectorOf<S, T>,
    ) -> T {
        T::constant(0.1, 0.0) * q.part(0)[0] * dq.part(0)[0]
    }
}

/// Prints how many times a scalar run members of an ensemble are on one thread of this CPU.
fn members<M: Scheme<Pendulum>>(scheme: M) {
    const STEP: f64 = 0.1;
    const STEPS: u64 = 20;
    let entry = scheme.entry();
    let all = starts();
    let start = |k: usize| State::new([all.q[k]], [all.p[k]]);
    let (mut alone, mut together) = (Duration::MAX, Duration::MAX);
    for _ in 0..5 {
        let run = Integrator::new(&Pendulum::default(), scheme.clone(), start(0), STEP);
        let mut run = run.expect("a run begins").with_lanes(false);
        let began = Instant::now();
        run.advance(STEPS * COUNT as u64)
            .expect("every step is solved");
        alone = alone.min(began.elapsed());
        let member = |member: Member| (Pendulum::default(), start(member.index));
        let swarm = Ensemble::new(COUNT, member, scheme.clone(), STEP);
        let mut swarm = swarm
            .expect("an ensemble begins")
            .with_threads(1)
            .reproducible();
        let began = Instant::now();
        swarm.advance(STEPS);
        together = together.min(began.elapsed());
        assert!(
            swarm.states().all(|end| end.is_ok()),
            "{entry}: every step is solved"
        );
    }
    println!(
        "{entry:<24} {:>8.2} ×",
        alone.as_secs_f64() / together.as_secs_f64()
    );
}
