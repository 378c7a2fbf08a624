//! H(t) with jumps at the ends of steps, of members in lanes: each lane has jumps, steps and times of its own.
//!
//! Input: random strengths, times of jumps, starts, steps and numbers of steps. Output: the ends of members. Control:
//! smooth runs one after the other, the equations of motion by a Runge-Kutta method written by hand, and a kick that
//! evaluates V(t) at the ends of steps.

use super::*;
use hamiltonian::Status;
use hamiltonian::errors::{StartError, SweepError};
use hamiltonian::schemes::SymplecticEuler;

hamiltonian! {
    /// An oscillator whose strength jumps twice.
    pub struct Jumping { first = 1.0, second = 2.0, a = 1.0, b = 2.0, c = 0.5 }
    H(q; p; t) = p^2/2 + (if t < first { a } else if t <= second { b } else { c })*(q^2/2 + q^4/4)
}

/// The generated members.
const MEMBERS: usize = 330;

/// A start, a step, the numbers of steps before each jump and after them, and the strengths.
struct Drawn {
    start: StateOf<Jumping>,
    step: f64,
    counts: [u64; 3],
    strengths: [f64; 3],
}

impl Drawn {
    fn new(member: Member) -> Self {
        let mut seed = member.seed | 1;
        let mut part = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        let sign = if part() < 0.7 { 1.0 } else { -1.0 };
        let mut strengths = [(); 3].map(|()| 0.5 + 1.5 * part());
        if part() < 0.3 {
            // As in lattices of accelerators.
            strengths[1] = 0.0;
        }
        Drawn {
            start: State::new([0.4 + part()], [part() - 0.5]).at(4.0 * part() - 2.0),
            step: sign * (0.04 + 0.04 * part()),
            counts: [(); 3].map(|()| 2 + (12.0 * part()) as u64),
            strengths,
        }
    }

    /// The system with steps of a fraction of the size.
    fn system(&self) -> Jumping {
        let at = |steps: u64| self.step * steps as f64 + self.start.t;
        let [first, second, _] = self.counts;
        let jumps = [at(first), at(first + second)];
        let [a, b, c] = self.strengths;
        if self.step > 0.0 {
            let [first, second] = jumps;
            Jumping {
                first,
                second,
                a,
                b,
                c,
            }
        } else {
            let [second, first] = jumps;
            Jumping {
                first,
                second,
                a: c,
                b,
                c: a,
            }
        }
    }

    fn steps(&self) -> u64 {
        self.counts.iter().sum()
    }

    /// The end of three smooth runs, each from the end of the one before.
    fn smooth(&self, finer: u64) -> [f64; 2] {
        let mut state = self.start.clone();
        for (steps, strength) in self.counts.iter().zip(self.strengths) {
            let (a, b, c) = (strength, strength, strength);
            let system = Jumping {
                a,
                b,
                c,
                ..self.system()
            };
            let step = self.step / finer as f64;
            let mut run = Integrator::new(&system, StormerVerlet::default(), state, step)
                .expect("a good start");
            state = run.advance(finer * steps).expect("finite").clone();
        }
        [state.q[0], state.p[0]]
    }

    /// The same by the equations of motion and many steps of a method of order 4.
    fn exact(&self) -> [f64; 2] {
        const PARTS: u64 = 24;
        let mut z = [self.start.q[0], self.start.p[0]];
        let h = self.step / PARTS as f64;
        for (steps, strength) in self.counts.iter().zip(self.strengths) {
            let slope = |[q, p]: [f64; 2]| [p, -strength * (q + q * q * q)];
            let moved = |z: [f64; 2], by: f64, k: [f64; 2]| [z[0] + by * k[0], z[1] + by * k[1]];
            for _ in 0..PARTS * steps {
                let first = slope(z);
                let second = slope(moved(z, h / 2.0, first));
                let third = slope(moved(z, h / 2.0, second));
                let fourth = slope(moved(z, h, third));
                z = moved(z, h / 6.0, first);
                z = moved(z, h / 3.0, second);
                z = moved(z, h / 3.0, third);
                z = moved(z, h / 6.0, fourth);
            }
        }
        z
    }

    /// Leapfrog that begins with the kick, and takes the strength from the time of the kick.
    fn with_kicks_at_jumps(&self, finer: u64) -> [f64; 2] {
        let Jumping {
            first,
            second,
            a,
            b,
            c,
        } = self.system();
        let strength = |t: f64| match t {
            t if t < first => a,
            t if t <= second => b,
            _ => c,
        };
        let h = self.step / finer as f64;
        let [mut q, mut p] = [self.start.q[0], self.start.p[0]];
        for made in 0..finer * self.steps() {
            let at = |steps: u64| self.step * steps as f64 / finer as f64 + self.start.t;
            p -= h / 2.0 * strength(at(made)) * (q + q * q * q);
            q += h * p;
            p -= h / 2.0 * strength(at(made + 1)) * (q + q * q * q);
        }
        [q, p]
    }
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).abs().max((a[1] - b[1]).abs())
}

fn jumping(member: Member) -> (Jumping, StateOf<Jumping>) {
    let drawn = Drawn::new(member);
    (drawn.system(), drawn.start)
}

/// The ends of all members, with steps of a fraction of the size.
fn ends(finer: u64) -> Vec<[f64; 2]> {
    let last = |drawn: &Drawn| drawn.step * drawn.steps() as f64 + drawn.start.t;
    let sweep = Sweep::new(MEMBERS, jumping, StormerVerlet::default(), 1.0)
        .with_step_each(|member| Drawn::new(member).step / finer as f64)
        .with_end_each(|member| last(&Drawn::new(member)))
        .with_chunk(97)
        .reproducible()
        .record(["q", "p"], |end| [end.state.q[0], end.state.p[0]]);
    let take = |mut all: Vec<_>, row: &hamiltonian::Row<'_>| {
        assert_eq!(row.status, Status::Ended, "{:?}", row.error);
        assert_eq!(
            row.steps,
            finer * Drawn::new(Member::new(row.index, 0)).steps()
        );
        all.push([row.values[0], row.values[1]]);
        all
    };
    sweep.fold(vec![], take).expect("rows")
}

#[test]
fn members_with_jumps_at_the_ends_of_steps_have_order_2() {
    at_each_level(|cpu| {
        let [coarse, fine, finest] = [1, 4, 8].map(ends);
        let mut lost = 0;
        for index in 0..MEMBERS {
            let drawn = Drawn::new(Member::new(index, 0));
            let place = format!("{cpu:?}, member {index}: {:?}", drawn.system());
            // The bits of a single run, and smooth runs one after the other.
            let system = drawn.system();
            let (scheme, start) = (StormerVerlet::default(), drawn.start.clone());
            let mut run = Integrator::new(&system, scheme, start, drawn.step).expect("accepted");
            let end = run.advance(drawn.steps()).expect("finite");
            assert_eq!([end.q[0], end.p[0]], coarse[index], "{place}");
            let off = distance(coarse[index], drawn.smooth(1));
            assert!(off < 1e-12, "{off} {place}");
            let exact = drawn.exact();
            let [before, after] = [&fine, &finest].map(|ends| distance(ends[index], exact));
            let slope = (before / after).log2();
            assert!(
                (slope - 2.0).abs() < 0.15,
                "{slope}, {before:e} {after:e} {place}"
            );
            let [before, after] = [4, 8].map(|by| distance(drawn.with_kicks_at_jumps(by), exact));
            lost += usize::from((before / after).log2() < 1.5);
        }
        assert!(lost > MEMBERS / 2, "{lost} of the control lose their order");
    });
}

#[test]
fn an_ensemble_refuses_what_a_single_run_refuses() {
    let _level = one_level();
    let mut swarm = Ensemble::new(7, jumping, SymplecticEuler::default(), 0.1).expect("members");
    swarm.advance(3);
    for end in swarm.states() {
        let error = end.expect_err("refused");
        let Error::Sweep(SweepError::Member { error, .. }) = error else {
            panic!("{error}");
        };
        assert!(
            matches!(*error, Error::Start(StartError::Jumps { .. })),
            "{error}"
        );
    }
}
