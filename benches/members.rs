//! Ensembles through the public API, on every level of this CPU, against the kernel one writes by hand.
//!
//! `cargo bench --bench members` prints, for pendulums and Störmer–Verlet, million trajectory-steps a
//! second: the kernel of `benches/ensemble.rs`, [`Ensemble`] on one thread, and what parameters per member,
//! `reproducible`, failing members, time in H, an observer of the energy at each step, a section and a Lyapunov
//! exponent cost. The observer of the energy is also written by hand, with a sine and a cosine at once in each
//! step. Rounds alternate, and CPU time is compared.
//!
//! With `-- --threads` it compares one thread with two on the best level instead: by the wall time, for which two
//! cores must be free, and by the CPU time, of which other programs take little.

#[path = "support/threads.rs"]
mod threads;

use std::hint::black_box;
use std::time::Instant;

use hamiltonian::lanes::{Cpu, Kernel, Level, Pack, dispatch};
use hamiltonian::prelude::*;
use hamiltonian::{
    Scheme,
    schemes::author::{Carried, Clock, Map, Scratch, Step},
};

hamiltonian! {
    /// A planar pendulum.
    pub struct Pendulum { m = 1.0, l = 10.0, g = 9.81 }
    H(q; p) = p^2/(2*m*l^2) - m*g*l*cos(q);
    event bottom = q
}

hamiltonian! {
    /// A pendulum that is pushed more and more.
    pub struct Pushed { m = 1.0, l = 10.0, g = 9.81, a = 0.1 }
    H(q; p; t) = p^2/(2*m*l^2) - m*g*l*cos(q) - a*q*t
}

const COUNT: usize = 100_000;
const STEPS: u64 = 1_000;
const STEP: f64 = 1e-3;

/// All trajectories by the scheme's own map.
struct Steps<'a> {
    system: &'a Pendulum,
    q: &'a mut [f64],
    p: &'a mut [f64],
}

impl Kernel for Steps<'_> {
    type Output = ();
    #[inline(always)]
    fn run<L: Level>(self) {
        let h = L::Wide::constant(STEP, 0.0);
        let prepared = <Pendulum as System>::prepare::<L::Wide>(self.system);
        let scheme = StormerVerlet::default();
        let map = Scheme::<Pendulum>::prepare(&scheme, &prepared, Step::of(h));
        let clock = Clock::new(L::Wide::zero(), h);
        let lanes = L::Wide::LANES as usize;
        for (some_q, some_p) in self.q.chunks_mut(lanes).zip(self.p.chunks_mut(lanes)) {
            let start = State::over([L::Wide::load(some_q, 0.0)], [L::Wide::load(some_p, 0.0)]);
            let mut carried = Scheme::<Pendulum>::start(&scheme, &prepared, &start, h);
            // The scratch of a splitting is nothing.
            #[allow(clippy::let_unit_value)]
            let mut work = Scratch::like(&carried);
            map.run(clock, 0, STEPS, &mut carried, &mut work);
            map.close(clock.at(STEPS), &mut carried, &mut work);
            let point = carried.point();
            point.q[0].store(some_q);
            point.p[0].store(some_p);
        }
    }
}

/// All trajectories with the drift of H, by hand.
struct Drifts<'a> {
    system: &'a Pendulum,
    q: &'a mut [f64],
    p: &'a mut [f64],
    /// The largest sizes, of which each call makes new ones.
    most: &'a mut [f64],
}

impl Kernel for Drifts<'_> {
    type Output = ();
    #[inline(always)]
    fn run<L: Level>(self) {
        let Pendulum { m, l, g } = *self.system;
        let number = |x| L::Wide::constant(x, 0.0);
        let (kick, half) = (number(-STEP * m * g * l), number(-STEP / 2.0 * m * g * l));
        let drift = number(STEP / (m * l * l));
        let (kinetic, depth) = (number(0.5 / (m * l * l)), number(-m * g * l));
        let lanes = L::Wide::LANES as usize;
        let chunks = self.q.chunks_mut(lanes).zip(self.p.chunks_mut(lanes));
        for ((some_q, some_p), most) in chunks.zip(self.most.chunks_mut(lanes)) {
            let (mut q, mut p) = (L::Wide::load(some_q, 0.0), L::Wide::load(some_p, 0.0));
            let (sine, cosine) = q.sin_cos();
            let begin = kinetic.fma(p * p, depth * cosine);
            let (mut max, mut sizes, mut sum) = (L::Wide::zero(), L::Wide::zero(), L::Wide::zero());
            p = half.fma(sine, p);
            for _ in 0..STEPS {
                q = drift.fma(p, q);
                let (sine, cosine) = q.sin_cos();
                let closed = half.fma(sine, p);
                let change = kinetic.fma(closed * closed, depth * cosine) - begin;
                let size = change.abs();
                max = L::Wide::select(max.lt(size), size, max);
                sizes += size;
                sum += change;
                p = kick.fma(sine, p);
            }
            black_box((&sizes, &sum));
            // The last kick was one for the next step.
            p = half.fma(-q.sin(), p);
            q.store(some_q);
            p.store(some_p);
            max.store(most);
        }
    }
}

fn start(index: usize) -> [f64; 2] {
    let at = index as f64 / COUNT as f64;
    [3.0 * at - 1.5, 20.0 * (at - 0.5)]
}

/// Seconds that the work takes: of this thread on the CPU, where Linux tells; else of wall time.
fn seconds(work: impl FnOnce()) -> f64 {
    let clock = Instant::now();
    let now = || {
        let line = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
        let first = line.as_deref().and_then(|line| line.split(' ').next());
        let nanoseconds = first.and_then(|first| first.parse::<f64>().ok());
        nanoseconds.map_or_else(|| clock.elapsed().as_secs_f64(), |n| n * 1e-9)
    };
    let begin = now();
    work();
    now() - begin
}

/// Prints how many times as fast two threads are as one, and how much CPU time they take.
fn compare_threads(swarm: impl Fn() -> Ensemble<Pendulum, StormerVerlet>) {
    let mut swarms = [swarm().with_threads(1), swarm().with_threads(2)];
    threads::compare("pendulums", 20, |k| {
        swarms[k].advance(4 * STEPS);
    });
}

fn main() {
    let best = Cpu::best();
    let state = |member: Member| {
        let [q, p] = start(member.index);
        State::new([q], [p])
    };
    let plain = |member: Member| (Pendulum::default(), state(member));
    let each = |member: Member| {
        let l = 10.0 + 1e-6 * member.index as f64;
        (
            Pendulum {
                l,
                ..Default::default()
            },
            state(member),
        )
    };
    let failing = |member: Member| {
        let (system, mut state) = plain(member);
        if member.index % 100 == 50 {
            state.p[0] = 1e305; // the angle overflows on the way
        }
        (system, state)
    };
    let pushed = |member: Member| (Pushed::default(), state(member));
    let scheme = StormerVerlet::default;
    if std::env::args().any(|argument| argument == "--threads") {
        let swarm = || Ensemble::new(COUNT, plain, scheme(), STEP).expect("there are members");
        return compare_threads(swarm);
    }
    for cpu in [Cpu::Sse2, Cpu::Avx2, Cpu::Avx512] {
        if cpu > best {
            continue;
        }
        Cpu::limit_to(cpu);
        let swarm = |make: &dyn Fn(Member) -> (Pendulum, StateOf<Pendulum>)| {
            Ensemble::new(COUNT, make, scheme(), STEP)
                .expect("there are members")
                .with_threads(1)
        };
        let mut all = [
            ("set-up", swarm(&plain)),
            ("ensemble", swarm(&plain)),
            ("parameters per member", swarm(&each)),
            ("1 % failing", swarm(&failing)),
        ];
        let mut exact = swarm(&plain).reproducible();
        let mut timed = Ensemble::new(COUNT, pushed, scheme(), STEP)
            .expect("there are members")
            .with_threads(1);
        let (mut q, mut p): (Vec<f64>, Vec<f64>) = (0..COUNT).map(|k| start(k).into()).unzip();
        let mut most = vec![0.0; COUNT];
        let mut least = [f64::INFINITY; 11];
        let mut drifts = swarm(&plain).observe(|_| EnergyDrift::new());
        let section = |_| Events::new([Event::named("bottom").with_direction(1)]);
        let mut sections = swarm(&plain).observe(section);
        let system = black_box(Pendulum::default());
        for _ in 0..5 {
            let mut times = [0.0; 11];
            times[0] = seconds(|| {
                dispatch(Steps {
                    system: &system,
                    q: &mut q,
                    p: &mut p,
                });
            });
            times[3] = seconds(|| {
                exact.advance(STEPS);
            });
            for ((name, swarm), k) in all.iter_mut().zip([1, 2, 4, 5]) {
                times[k] = seconds(|| match *name {
                    "set-up" => {
                        *swarm =
                            Ensemble::new(COUNT, plain, scheme(), STEP).expect("there are members");
                    }
                    _ => {
                        swarm.advance(STEPS);
                    }
                });
            }
            times[6] = seconds(|| {
                timed.advance(STEPS);
            });
            times[7] = seconds(|| {
                drifts.advance(STEPS);
            });
            times[8] = seconds(|| {
                sections.advance(STEPS);
            });
            times[9] = seconds(|| {
                let rates = Lyapunov::new(COUNT, plain, scheme(), STEP)
                    .with_steps(STEPS)
                    .with_threads(1)
                    .collect();
                black_box(rates.expect("there are members"));
            });
            times[10] = seconds(|| {
                dispatch(Drifts {
                    system: &system,
                    q: &mut q,
                    p: &mut p,
                    most: &mut most,
                });
            });
            for (least, time) in least.iter_mut().zip(times) {
                *least = time.min(*least);
            }
        }
        let names = [
            "kernel by hand",
            "set-up",
            "ensemble",
            "reproducible",
            "parameters per member",
            "1 % failing",
            "time-dependent",
            "EnergyDrift at each step",
            "section event",
            "Lyapunov exponent",
            "EnergyDrift by hand",
        ];
        for (name, time) in names.into_iter().zip(least) {
            let rate = COUNT as f64 * STEPS as f64 / time / 1e6;
            match name {
                "set-up" => println!(
                    "{cpu:?} set-up: {:.1} steps of a member",
                    time / least[2] * STEPS as f64
                ),
                _ => println!(
                    "{cpu:?} {name}: {rate:.1} M steps/s, {:.3} of the kernel, {:.2} × the ensemble",
                    least[0] / time,
                    time / least[2]
                ),
            }
        }
    }
}
