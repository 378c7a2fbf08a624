//! Runs of lattices and bodies in rounds, by the library and by hand.
//!
//! Input: workloads. Output: their times, the fastest of many short alternating rounds in one process.

use hamiltonian::prelude::*;
use hamiltonian_lanes::{Cpu, Kernel, Level, Nf, Pack, dispatch};
use std::hint::black_box;
use std::time::{Duration, Instant};

pub const H: f64 = 1e-3;

/// A pseudorandom number in [−½, ½).
pub fn noise(k: usize) -> f64 {
    let bits = (k as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let bits = (bits ^ (bits >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    (bits >> 11) as f64 / (1u64 << 53) as f64 - 0.5
}

/// A force on the momenta and a drift of the coordinates, by hand: arrays of `f64`, by columns.
pub trait ByHand: Copy {
    /// p += c·f(q).
    fn kick<P: Pack>(self, q: &[f64], p: &mut [f64], work: &mut [f64], c: f64);
    /// q += c·∂T/∂p.
    fn drift<P: Pack>(self, q: &mut [f64], p: &[f64], c: f64);
}

/// Störmer–Verlet steps with fused kicks.
struct Steps<'a, S> {
    system: S,
    q: &'a mut [f64],
    p: &'a mut [f64],
    work: &'a mut [f64],
    count: usize,
}

impl<S: ByHand> Steps<'_, S> {
    #[inline(always)]
    fn over<P: Pack>(self) {
        let Steps {
            system,
            q,
            p,
            work,
            count,
        } = self;
        system.kick::<P>(q, p, work, 0.5 * H);
        for k in 1..=count {
            system.drift::<P>(q, p, H);
            let c = if k == count { 0.5 * H } else { H };
            system.kick::<P>(q, p, work, c);
        }
    }
}

impl<S: ByHand> Kernel for Steps<'_, S> {
    type Output = ();
    #[inline(always)]
    fn run<L: Level>(self) {
        self.over::<Nf<L::Eight>>();
    }
}

/// `into += c·by`, one after the other.
#[inline(always)]
pub fn add<P: Pack>(into: &mut [f64], by: &[f64], c: f64) {
    let lanes = P::LANES as usize;
    let c = P::constant(c, 0.0);
    for (to, from) in into.chunks_mut(lanes).zip(by.chunks(lanes)) {
        c.fma(P::load(from, 0.0), P::load(to, 0.0)).store(to);
    }
}

/// The end of a run, and the time of its steps after the first one.
pub type Timed = (Vec<f64>, Duration);

/// A workload: its units of work in a step, the number of steps of a round, and the runs of it.
pub struct Workload {
    /// Its name.
    pub name: &'static str,
    /// The units of work of a step.
    pub units: f64,
    /// The steps of a round.
    pub steps: usize,
    /// The run by the library, with fused products or not.
    pub library: fn(usize, bool) -> Timed,
    /// The run by hand in lanes.
    pub lanes: fn(usize) -> Timed,
    /// The run by hand without.
    pub scalar: fn(usize) -> Timed,
}

/// Numbers for coordinates and momenta.
pub fn start(n: usize, columns: usize) -> (Vec<f64>, Vec<f64>) {
    let numbers = |from: usize| (0..n * columns).map(|k| noise(from + k)).collect();
    (numbers(0), numbers(1 << 20))
}

/// The end of a run by the library.
pub fn run<S>(system: &S, start: (Vec<f64>, Vec<f64>), steps: usize, fused: bool) -> Timed
where
    S: System,
    StormerVerlet: Scheme<S>,
{
    let mut state = State {
        q: system.zeros(),
        p: system.zeros(),
        t: 0.0,
    };
    Vector::part_mut(&mut state.q, 0).copy_from_slice(&start.0);
    Vector::part_mut(&mut state.p, 0).copy_from_slice(&start.1);
    let mut run = Integrator::new(system, StormerVerlet::default(), state, H).unwrap();
    if fused {
        run = run.fused();
    }
    // The first step allocates.
    run.advance(1).unwrap();
    let began = Instant::now();
    run.advance(black_box(steps as u64)).unwrap();
    let time = began.elapsed();
    let end = run.state();
    let [q, p] = [&end.q, &end.p].map(|vector| Vector::part(vector, 0));
    ([q, p].concat(), time)
}

/// The end of a run by hand.
pub fn by_hand<S: ByHand>(
    system: S,
    start: (Vec<f64>, Vec<f64>),
    mut work: Vec<f64>,
    steps: usize,
    lanes: bool,
) -> Timed {
    let (mut q, mut p) = start;
    let mut advance = |count| {
        let all = Steps {
            system,
            q: &mut q,
            p: &mut p,
            work: &mut work,
            count: black_box(count),
        };
        let began = Instant::now();
        if lanes {
            dispatch(all);
        } else {
            all.over::<f64>();
        }
        began.elapsed()
    };
    advance(1);
    let time = advance(steps);
    ([q, p].concat(), time)
}

/// Compares and times workloads.
pub fn main(all: &[Workload]) {
    let check = std::env::args().any(|argument| argument == "--check");
    let part = std::env::args().skip(1).find(|a| !a.starts_with("--"));
    let is_asked = |workload: &&Workload| {
        let part = part.as_deref().unwrap_or_default();
        workload.name.contains(part)
    };
    let all: Vec<&Workload> = all.iter().filter(is_asked).collect();
    let mut failed = 0;
    for workload in &all {
        let [lanes, scalar] = [workload.lanes, workload.scalar].map(|run| run(10).0);
        let [library, fused] = [false, true].map(|fused| (workload.library)(10, fused).0);
        let ends = [library, lanes, scalar, fused];
        for end in &ends[1..] {
            let distance = (ends[0].iter().zip(end)).map(|(a, b)| (a - b).abs());
            let most = distance.fold(0.0, f64::max);
            // Roundings of ten steps in other orders.
            if most >= 1e-11 || most.is_nan() {
                println!("FAILED {}: ends differ by {most:e}", workload.name);
                failed += 1;
            }
        }
    }
    if check {
        println!("{} workloads, {failed} failed", all.len());
        std::process::exit(i32::from(failed > 0));
    }
    println!(
        "{:<30} {:>8} {:>10} {:>10} {:>10} {:>12} {:>12} {:>10} {:>12}",
        "workload",
        "level",
        "library ns",
        "lanes ns",
        "scalar ns",
        "× of lanes",
        "× of scalar",
        "fused ns",
        "× of scalar"
    );
    for limit in Cpu::available().collect::<Vec<_>>().into_iter().rev() {
        Cpu::limit_to(limit);
        if limit == Cpu::Portable {
            continue;
        }
        for workload in &all {
            let runs: [&dyn Fn(usize) -> Timed; 4] = [
                &|steps| (workload.library)(steps, false),
                &workload.lanes,
                &workload.scalar,
                &|steps| (workload.library)(steps, true),
            ];
            let work = workload.units * workload.steps as f64;
            let mut fastest = [Duration::MAX; 4];
            for _ in 0..(1e9 / work).clamp(24.0, 240.0) as usize {
                for (fastest, run) in fastest.iter_mut().zip(runs) {
                    // Rounds are short, so that the fastest of many is not disturbed by other processes.
                    *fastest = (*fastest).min(run(workload.steps).1);
                }
            }
            let [library, lanes, scalar, fused] = fastest.map(|t| t.as_secs_f64() * 1e9 / work);
            println!(
                "{:<30} {:>8} {library:>10.3} {lanes:>10.3} {scalar:>10.3} {:>12.2} {:>12.2} {fused:>10.3} {:>12.2}",
                workload.name,
                format!("{limit:?}"),
                lanes / library,
                scalar / library,
                scalar / fused
            );
        }
    }
}
