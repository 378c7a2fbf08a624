//! The domain of H: runs that leave it, and where they are found.

use crate::common::systems::{Formula, Halves, Hand, scalar};
use hamiltonian_core::schemes::author::Group;
use hamiltonian_core::schemes::{
    BlanesMoan4, Gauss, ImplicitMidpoint, RungeKutta4, StormerVerlet, Yoshida4,
};
use hamiltonian_core::{
    Error, Integrator, Real, Scheme, State,
    observers::{EnergyDrift, Recorder},
};

/// The steps of a block.
const BLOCK: usize = 1024;

/// H = p²/2 + g·x − k·ln x, or the same with ln |x|, which has the same derivatives and is defined on both sides.
#[derive(Debug, Clone)]
struct Wall<const GUARDED: bool> {
    g: f64,
    k: f64,
}

impl<const GUARDED: bool> Formula<1> for Wall<GUARDED> {
    const NAME: &'static str = "Wall";
    const GROUPS: &'static [Group] = &[scalar("x", "p", 0)];
    fn energy<T: Real>(&self, _: T, [x]: &[T; 1], [p]: &[T; 1]) -> T {
        let [g, k, half] = [self.g, self.k, 0.5].map(|c| T::constant(c, 0.0));
        let size = if GUARDED { *x } else { x.abs() };
        half * *p * *p + g * *x - k * size.ln()
    }
    fn gradient<T: Real>(&self, t: T, q: &[T; 1], p: &[T; 1]) -> ([T; 1], [T; 1]) {
        (self.force(t, q), *p)
    }
}

impl<const GUARDED: bool> Halves<1> for Wall<GUARDED> {
    /// ∂V/∂x
    fn force<T: Real>(&self, _: T, [x]: &[T; 1]) -> [T; 1] {
        let [g, k] = [self.g, self.k].map(|c| T::constant(c, 0.0));
        [g - k / *x]
    }
    fn velocity<T: Real>(&self, _: T, p: &[T; 1]) -> [T; 1] {
        *p
    }
}

/// A linear congruential generator of numbers from 0 to 1.
struct Numbers(u64);

impl Numbers {
    fn part(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The outcomes of the generated runs.
#[derive(Debug, Default)]
struct Seen {
    inside: u32,
    left: u32,
    later: u32,
    returned: u32,
}

/// One generated run: a wall, a start, a step and a number of steps.
struct Case {
    g: f64,
    k: f64,
    start: State<hamiltonian_core::private::SVector<f64, 1>>,
    h: f64,
    n: usize,
}

impl Case {
    /// A slow fall of many steps, or a fast one that may come back.
    fn new(numbers: &mut Numbers) -> Self {
        let is_slow = numbers.part() < 0.4;
        let mut between = |slow: [f64; 2], fast: [f64; 2]| {
            let [from, to] = if is_slow { slow } else { fast };
            from + (to - from) * numbers.part()
        };
        Case {
            g: between([0.02, 0.1], [-0.9, 1.1]),
            k: 10_f64.powf(between([-4.0, -2.0], [-4.0, -1.0])),
            start: State::new(
                [between([0.5, 1.2], [0.1, 1.1])],
                [between([-0.3, 0.2], [-1.2, 0.3])],
            ),
            h: between([0.002, 0.006], [0.01, 0.06]),
            n: between([1000.0, 3000.0], [1.0, 900.0]) as usize,
        }
    }

    /// Compares a run with one whose H is defined everywhere, which has the same bits.
    fn check<M>(&self, scheme: M, seen: &mut Seen)
    where
        M: Scheme<f64, Hand<Wall<true>, 1>> + Scheme<f64, Hand<Wall<false>, 1>>,
    {
        let Case { g, k, h, n, .. } = *self;
        let (guarded, free) = (Hand(Wall::<true> { g, k }), Hand(Wall::<false> { g, k }));
        let new = || Integrator::new(&guarded, scheme.clone(), self.start.clone(), h);
        let path = Integrator::new(&free, scheme.clone(), self.start.clone(), h);
        let mut path = path.expect("a good start");
        let states: Vec<_> = (0..n)
            .map_while(|_| path.advance(1).ok().cloned())
            .collect();
        if states.len() < n {
            return;
        }
        let is_outside = |step: usize| states[step - 1].q[0] <= 0.0;
        // H is evaluated at the ends of blocks.
        let ends = (BLOCK..n).step_by(BLOCK).chain([n]);
        let found = ends.clone().find(|end| is_outside(*end));
        let expected = found.and_then(|end| {
            let begin = (end - 1) / BLOCK * BLOCK;
            (begin + 1..=end).find(|step| is_outside(*step))
        });
        let mut run = new().expect("a good start");
        let result = run.advance(n as u64).cloned();
        match expected {
            None => {
                assert_eq!(result.expect("inside at the ends of blocks"), states[n - 1]);
                match (1..=n).any(is_outside) {
                    true => seen.returned += 1,
                    false => seen.inside += 1,
                }
            }
            Some(bad) => {
                let Err(Error::NotFinite {
                    step,
                    energy,
                    time,
                    q,
                    p,
                    piece,
                    ..
                }) = result
                else {
                    panic!("step {bad} is outside: {result:?}");
                };
                let state = &states[bad - 1];
                assert_eq!((step, time), (bad as u64, state.t));
                assert_eq!((q[0], p[0]), (state.q[0], state.p[0]));
                assert!(energy.is_some_and(f64::is_nan) && piece.is_none());
                // The run stands at the last good state.
                assert_eq!(run.steps(), bad as u64 - 1);
                let before = if bad == 1 {
                    &self.start
                } else {
                    &states[bad - 2]
                };
                assert_eq!(run.state(), before);
                let text = run.advance(1).expect_err("the same step again").to_string();
                assert!(
                    text.contains("H is NaN") && text.contains("end the run"),
                    "{text}"
                );
                seen.left += 1;
                seen.later += u32::from(bad > BLOCK);
            }
        }
        // Observers receive no state outside: theirs are ends of blocks.
        let first = (1..=n).find(|step| is_outside(*step));
        let mut watched = new()
            .expect("a good start")
            .observe((EnergyDrift::new(), Recorder::of(["x"])));
        let result = watched.advance(n as u64).map(|_| ());
        assert_eq!(result.is_err(), first.is_some());
        assert_eq!(watched.steps() as usize, first.map_or(n, |step| step - 1));
        let recorder = &watched.observer().1;
        assert!(recorder.column("x").expect("a column").all(|x| x > 0.0));
        assert!(watched.observer().0.max_relative().is_finite());
        // So are parts of steps: a time between the last good state and the first bad one.
        if let Some(bad) = first {
            let mut run = new().expect("a good start");
            run.advance(bad as u64 - 1).expect("inside");
            let part = run.state_at(run.state().t + h);
            // An implicit step by itself begins with another iterate, and may not be solved.
            let is_refused = matches!(
                part,
                Err(Error::NotFinite {
                    energy: Some(_),
                    ..
                } | Error::Solve { .. })
            );
            assert!(is_refused, "{part:?}");
        }
    }
}

#[test]
fn generated_runs_that_leave_the_domain_of_h_are_errors() {
    let mut numbers = Numbers(381);
    let mut seen = Seen::default();
    for case in 0..420 {
        let run = Case::new(&mut numbers);
        match case % 6 {
            0 => run.check(StormerVerlet::default(), &mut seen),
            1 => run.check(BlanesMoan4, &mut seen),
            2 => run.check(Yoshida4, &mut seen),
            3 => run.check(RungeKutta4, &mut seen),
            4 => run.check(ImplicitMidpoint::default(), &mut seen),
            _ => run.check(Gauss::<2>::default(), &mut seen),
        }
    }
    // Runs of each kind: also those that come back, which are not found.
    let Seen {
        inside,
        left,
        later,
        returned,
    } = seen;
    assert!(
        inside > 60 && left > 100 && later > 5 && returned > 10,
        "{seen:?}"
    );
}

#[test]
fn the_quoted_run_is_an_error() {
    let quoted = || {
        let system = Hand(Wall::<true> { g: 1.0, k: 0.01 });
        Integrator::new(
            &system,
            StormerVerlet::default(),
            State::new([1.0], [-1.0]),
            0.05,
        )
    };
    let error = quoted().unwrap().advance(100).unwrap_err();
    let Error::NotFinite {
        step, energy, q, ..
    } = &error
    else {
        panic!("{error}");
    };
    assert!(
        *step < 30 && energy.unwrap().is_nan() && q[0] <= 0.0,
        "{error}"
    );
    let last = quoted().unwrap().states(1).last();
    let last = last.expect("states").expect_err("the last one");
    assert_eq!(last.to_string(), error.to_string());
}
