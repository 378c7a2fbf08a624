//! The domain of H: runs that leave it, and where they are found.
//!
//! Input: random potentials that end at x = 0, starts, steps, schemes and calls. Output: states and errors. Control: H
//! without the part that ends, whose states are the same bits, and loops written by hand.

use crate::common::four::Four;
use crate::common::random::{Random, cases};
use crate::common::systems::{Formula, Halves, Hand, number};
use hamiltonian_core::errors::StepError;
use hamiltonian_core::private::SVector;
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

/// A function f that is not finite at or beyond x = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Edge {
    /// −ln x, whose derivative has values beyond.
    Ln,
    /// (√x)², with the derivative 1.
    Root,
    /// x^(5/2), without a derivative beyond.
    Power,
    /// asin(1 − x), from 0 to 2, without a derivative beyond.
    Arc,
    /// atanh(1 − x), from 0 to 2, whose derivative has values beyond.
    Area,
    /// 1/x, which is infinite at a point that steps meet.
    Pole,
    /// A step to infinity, with the derivative 0.
    Overflow,
}

const EDGES: [Edge; 7] = [
    Edge::Ln,
    Edge::Root,
    Edge::Power,
    Edge::Arc,
    Edge::Area,
    Edge::Pole,
    Edge::Overflow,
];

/// H = p²/2 + g·x + k·f(x), or without k·f(x) but with the same derivatives.
#[derive(Debug, Clone)]
struct Ending {
    edge: Edge,
    g: f64,
    k: f64,
    is_guarded: bool,
}

impl Formula<1> for Ending {
    const NAME: &'static str = "Ending";
    const GROUPS: &'static [Group] = &[Group::scalar("x", "p", 0)];
    fn energy<T: Real>(&self, _: T, [x]: &[T; 1], [p]: &[T; 1]) -> T {
        let everywhere = number::<T>(0.5) * *p * *p + number::<T>(self.g) * *x;
        if self.is_guarded {
            return everywhere;
        }
        let from_one = T::one() - *x;
        let value = match self.edge {
            Edge::Ln => -x.ln(),
            Edge::Root => x.sqrt() * x.sqrt(),
            Edge::Power => *x * *x * x.sqrt(),
            Edge::Arc => from_one.asin(),
            Edge::Area => from_one.atanh(),
            Edge::Pole => T::one() / *x,
            Edge::Overflow => {
                let factor = T::select(x.lt(T::zero()), number(4.0), number(0.25));
                number::<T>(1e308) * factor
            }
        };
        everywhere + number::<T>(self.k) * value
    }
    fn gradient<T: Real>(&self, t: T, q: &[T; 1], p: &[T; 1]) -> ([T; 1], [T; 1]) {
        (self.force(t, q), *p)
    }
}

impl Halves<1> for Ending {
    /// ∂V/∂x
    fn force<T: Real>(&self, _: T, [x]: &[T; 1]) -> [T; 1] {
        let from_one = T::one() - *x;
        let rest = T::one() - from_one * from_one;
        let slope = match self.edge {
            Edge::Ln => -(T::one() / *x),
            Edge::Root => T::one(),
            Edge::Power => number::<T>(2.5) * *x * x.sqrt(),
            Edge::Arc => -(T::one() / rest.sqrt()),
            Edge::Area => -(T::one() / rest),
            Edge::Pole => -(T::one() / (*x * *x)),
            Edge::Overflow => T::zero(),
        };
        [number::<T>(self.g) + number::<T>(self.k) * slope]
    }
    fn velocity<T: Real>(&self, _: T, p: &[T; 1]) -> [T; 1] {
        *p
    }
}

/// f(x) and f′(x) by the standard library.
fn by_hand(edge: Edge, x: f64) -> [f64; 2] {
    let from_one = 1.0 - x;
    let rest = 1.0 - from_one * from_one;
    match edge {
        Edge::Ln => [-x.ln(), -(1.0 / x)],
        Edge::Root => [x.sqrt() * x.sqrt(), 1.0],
        Edge::Power => [x.powf(2.5), 2.5 * x * x.sqrt()],
        Edge::Arc => [from_one.asin(), -(1.0 / rest.sqrt())],
        Edge::Area => [from_one.atanh(), -(1.0 / rest)],
        Edge::Pole => [1.0 / x, -(1.0 / (x * x))],
        Edge::Overflow if x < 0.0 => [f64::INFINITY, 0.0],
        Edge::Overflow => [1.0, 0.0],
    }
}

/// The outcomes of the generated runs.
#[derive(Debug, Default)]
struct Seen {
    inside: u32,
    /// For each edge, runs that left the domain with finite numbers, and with others.
    left: [[u32; 2]; EDGES.len()],
    later: u32,
    returned: u32,
    by_hand: u32,
}

type Start = State<SVector<f64, 1>>;

/// One generated run: a potential, a start, a step, and the numbers of steps of its calls.
#[derive(Debug)]
struct Case {
    edge: Edge,
    g: f64,
    k: f64,
    start: Start,
    h: f64,
    calls: Vec<usize>,
}

impl Case {
    /// A slow fall of many steps, or a fast one that may come back.
    fn new(edge: Edge, random: &mut Random) -> Self {
        let is_slow = random.below(5) < 2;
        let mut between = |slow: [f64; 2], fast: [f64; 2]| {
            let [low, high] = if is_slow { slow } else { fast };
            random.between(low, high)
        };
        let mut case = Case {
            edge,
            g: between([0.02, 0.1], [-0.9, 1.1]),
            k: 10_f64.powf(between([-4.0, -2.0], [-4.0, -1.0])),
            start: State::new(
                [between([0.5, 1.2], [0.1, 1.1])],
                [between([-0.3, 0.2], [-1.2, 0.3])],
            ),
            h: between([0.002, 0.006], [0.01, 0.06]),
            calls: vec![between([1000.0, 3000.0], [1.0, 900.0]) as usize],
        };
        if edge == Edge::Pole {
            // Without a force, all positions are exact.
            (case.g, case.k) = (0.0, 1e-320);
            let binary = |n: u64, below: i32| n as f64 / f64::from(below);
            let x = binary(1 + random.below(64), 32);
            let p = -binary(1 + random.below(8), 8);
            case.start = State::new([x], [p]);
            case.h = [1.0 / 16.0, 1.0 / 64.0][random.below(2) as usize];
        }
        while random.below(2) == 0 {
            let last = case.calls.pop().unwrap_or(0);
            let first = random.below(last as u64 + 1) as usize;
            case.calls.extend([first, last - first]);
        }
        case
    }

    fn ending(&self, is_guarded: bool) -> Ending {
        let Case { edge, g, k, .. } = *self;
        Ending {
            edge,
            g,
            k,
            is_guarded,
        }
    }

    /// The first and the last step of each block. H is evaluated at the ends of blocks, which begin with each call.
    fn blocks(&self) -> Vec<(usize, usize)> {
        let mut blocks = Vec::new();
        let mut begin = 0;
        for call in &self.calls {
            let end = begin + call;
            for from in (begin..end).step_by(BLOCK) {
                blocks.push((from + 1, end.min(from + BLOCK)));
            }
            begin = end;
        }
        blocks
    }

    fn is_outside(&self, x: f64) -> bool {
        !(self.k * by_hand(self.edge, x)[0]).is_finite()
    }

    /// The states after each step of leapfrog, until a number is not finite.
    fn leapfrog(&self, start: &Start, begins_with_kick: bool, n: usize) -> Vec<[f64; 2]> {
        let (mut x, mut p) = (start.q[0], start.p[0]);
        let force = |x: f64| self.g + self.k * by_hand(self.edge, x)[1];
        let mut states = Vec::new();
        for step in 0..n {
            let (half, joined) = (self.h / 2.0, if step == 0 { self.h / 2.0 } else { self.h });
            let state = if begins_with_kick {
                p += -joined * force(x);
                x += self.h * p;
                [x, -half * force(x) + p]
            } else {
                x += joined * p;
                p += -self.h * force(x);
                [half * p + x, p]
            };
            if !state.iter().chain(&[x, p]).all(|number| number.is_finite()) {
                break;
            }
            states.push(state);
        }
        states
    }

    /// Compares a run with one whose H is defined everywhere, which has the same bits.
    fn check<M: Scheme<Hand<Ending, 1>>>(
        &self,
        scheme: M,
        begins_with_kick: Option<bool>,
        seen: &mut Seen,
    ) {
        let Case { edge, h, .. } = *self;
        let place = format!("{scheme:?} {self:?}");
        let (guarded, free) = (Hand(self.ending(true)), Hand(self.ending(false)));
        let new = || Integrator::new(&free, scheme.clone(), self.start.clone(), h);
        let path = Integrator::new(&guarded, scheme.clone(), self.start.clone(), h);
        let mut path = path.expect("a good start");
        let n: usize = self.calls.iter().sum();
        let mut states: Vec<State<_>> = Vec::new();
        for _ in 0..n {
            match path.advance(1) {
                Ok(state) => states.push(state.clone()),
                Err(Error::Step(StepError::NotFinite { .. })) => break,
                // An implicit step that is not solved is another error.
                Err(Error::Step(StepError::Unsolved { .. })) => return,
                Err(error) => panic!("{place}: {error}"),
            }
        }
        if let Some(begins_with_kick) = begins_with_kick {
            let expected = self.leapfrog(&self.start, begins_with_kick, n);
            let found: Vec<_> = states
                .iter()
                .map(|state| [state.q[0], state.p[0]])
                .collect();
            assert_eq!(found, expected, "{place}");
            seen.by_hand += 1;
        }
        // The first step without finite numbers.
        let broken = states.len() + 1;
        let is_bad = |step: usize| step >= broken || self.is_outside(states[step - 1].q[0]);
        let blocks = self.blocks();
        let expected = blocks
            .iter()
            .find(|(_, end)| is_bad(*end))
            .and_then(|(begin, end)| (*begin..=*end).find(|step| is_bad(*step)));
        let mut run = new().expect("a good start");
        let mut result = Ok(self.start.clone());
        for call in &self.calls {
            result = run.advance(*call as u64).cloned();
            if result.is_err() {
                break;
            }
        }
        let first = (1..=n).find(|step| is_bad(*step));
        match expected {
            None => {
                let end = result.expect("inside at the ends of blocks");
                assert_eq!(Some(&end), states.last().or(Some(&self.start)), "{place}");
                match first {
                    Some(_) => seen.returned += 1,
                    None => seen.inside += 1,
                }
            }
            Some(bad) => {
                let Err(Error::Step(StepError::NotFinite {
                    step,
                    energy,
                    time,
                    q,
                    p,
                    ..
                })) = result
                else {
                    panic!("step {bad} is outside: {result:?}, {place}");
                };
                assert_eq!(step, bad as u64, "{place}");
                let text = run.advance(1).expect_err("the same step again").to_string();
                let is_broken = bad == broken;
                assert_eq!(energy.is_none(), is_broken, "{place}");
                if !is_broken {
                    let state = &states[bad - 1];
                    assert_eq!((time, q[0], p[0]), (state.t, state.q[0], state.p[0]));
                    assert!(energy.is_some_and(|energy| !energy.is_finite()), "{place}");
                    assert!(
                        text.contains("H is ") && text.contains("end the run"),
                        "{text}"
                    );
                }
                // The run stands at the last good state.
                assert_eq!(run.steps(), bad as u64 - 1);
                let before = match bad {
                    1 => &self.start,
                    _ => &states[bad - 2],
                };
                assert_eq!(run.state(), before);
                let at = EDGES.iter().position(|one| *one == edge).expect("an edge");
                seen.left[at][usize::from(is_broken)] += 1;
                seen.later += u32::from(bad > BLOCK);
            }
        }
        // Observers receive no state outside: theirs are ends of blocks.
        let mut watched = new()
            .expect("a good start")
            .observe((EnergyDrift::new(), Recorder::of(["x"])));
        let result = watched.advance(n as u64).map(|_| ());
        assert_eq!(result.is_err(), first.is_some(), "{place}");
        assert_eq!(watched.steps() as usize, first.map_or(n, |step| step - 1));
        let recorder = &watched.observer().1;
        assert!(
            recorder
                .column("x")
                .expect("a column")
                .all(|x| !self.is_outside(x))
        );
        assert!(watched.observer().0.max_relative().is_finite());
        // So are parts of steps: a time between the last good state and the first bad one. The length of a part is
        // rounded, which moves points next to an edge.
        if let Some(bad) = first
            && edge != Edge::Pole
        {
            let mut run = new().expect("a good start");
            for _ in 1..bad {
                run.advance(1).expect("inside");
            }
            let part = run.state_at(run.state().t + h);
            // An implicit step by itself begins with another iterate, and may not be solved.
            let is_refused = matches!(part, Err(Error::Step(_)));
            assert!(is_refused, "{part:?} {place}");
        }
    }
}

#[test]
fn generated_runs_that_leave_the_domain_of_h_are_errors() {
    let mut seen = Seen::default();
    for seed in 0..cases(560, 20_000) {
        let mut random = Random(seed);
        let run = Case::new(EDGES[(seed / 8) as usize % EDGES.len()], &mut random);
        let kick = StormerVerlet::KickDriftKick;
        match seed % 8 {
            0 | 1 => run.check(kick, Some(true), &mut seen),
            2 | 3 => run.check(StormerVerlet::DriftKickDrift, Some(false), &mut seen),
            4 if run.edge == Edge::Pole => run.check(kick, Some(true), &mut seen),
            4 => run.check(BlanesMoan4, None, &mut seen),
            5 => run.check(Yoshida4, None, &mut seen),
            6 => run.check(RungeKutta4, None, &mut seen),
            7 if seed.is_multiple_of(3) => run.check(Gauss::<2>::default(), None, &mut seen),
            _ => run.check(ImplicitMidpoint::default(), None, &mut seen),
        }
    }
    // Runs of each kind: also those that come back, which are not found.
    let left: u32 = seen.left.iter().flatten().sum();
    assert!(
        seen.inside > 60 && left > 150 && seen.later > 5 && seen.returned > 10,
        "{seen:?}"
    );
    assert!(
        seen.by_hand > 250 && seen.left.iter().all(|[finite, broken]| finite + broken > 5),
        "{seen:?}"
    );
}

/// Four starts in the lanes of one run: the error names the first lane that is bad in the first bad step.
#[test]
fn the_first_lane_that_leaves_the_domain_is_named() {
    let (mut left, mut inside, mut lanes) = (0, 0, [0; 4]);
    for seed in 0..cases(350, 10_000) {
        let mut random = Random(1_000_000 + seed);
        let edge = EDGES[seed as usize % EDGES.len()];
        let case = Case::new(edge, &mut random);
        let starts = [(); 4].map(|()| Case::new(edge, &mut random).start);
        let n: usize = case.calls.iter().sum();
        let paths = starts.each_ref().map(|start| case.leapfrog(start, true, n));
        let is_broken = |lane: usize, step: usize| step > paths[lane].len();
        let is_outside = |lane: usize, step: usize| {
            !is_broken(lane, step) && case.is_outside(paths[lane][step - 1][0])
        };
        let first = |step: usize| {
            let broken = (0..4).find(|lane| is_broken(*lane, step));
            broken.or_else(|| (0..4).find(|lane| is_outside(*lane, step)))
        };
        let blocks = case.blocks();
        let expected = blocks
            .iter()
            .find(|(_, end)| first(*end).is_some())
            .and_then(|(begin, end)| (*begin..=*end).find_map(|step| Some((step, first(step)?))));
        let packed = |of: &dyn Fn(usize) -> f64| Four([0, 1, 2, 3].map(of));
        let start = State {
            t: Four([0.0; 4]),
            q: SVector::from([packed(&|lane| starts[lane].q[0])]),
            p: SVector::from([packed(&|lane| starts[lane].p[0])]),
        };
        let system = Hand(case.ending(false));
        let scheme = StormerVerlet::default();
        let mut run =
            Integrator::new(&system, scheme, start, Four([case.h; 4])).expect("a good start");
        let result = case
            .calls
            .iter()
            .try_for_each(|call| run.advance(*call as u64).map(|_| ()));
        let made = match (expected, result) {
            (None, Ok(())) => {
                inside += 1;
                n
            }
            (
                Some((bad, lane)),
                Err(Error::Step(StepError::NotFinite {
                    step,
                    lane: named,
                    energy,
                    ..
                })),
            ) => {
                assert_eq!((step, named), (bad as u64, Some(lane as u32)), "{case:?}");
                assert_eq!(energy.is_none(), is_broken(lane, bad), "{case:?}");
                left += 1;
                lanes[lane] += 1;
                bad - 1
            }
            (expected, result) => panic!("{expected:?}, {result:?}, {case:?}"),
        };
        for (lane, path) in paths.iter().enumerate() {
            let begin = [starts[lane].q[0], starts[lane].p[0]];
            let state = if made == 0 { begin } else { path[made - 1] };
            assert_eq!([run.state().q[0].0[lane], run.state().p[0].0[lane]], state);
        }
    }
    assert!(
        left > 100 && inside > 30 && lanes.iter().all(|n| *n > 10),
        "{left} {inside} {lanes:?}"
    );
}

#[test]
fn the_quoted_run_is_an_error() {
    let quoted = || {
        let system = Hand(Ending {
            edge: Edge::Ln,
            g: 1.0,
            k: 0.01,
            is_guarded: false,
        });
        Integrator::new(
            &system,
            StormerVerlet::default(),
            State::new([1.0], [-1.0]),
            0.05,
        )
    };
    let error = quoted().unwrap().advance(100).unwrap_err();
    let Error::Step(StepError::NotFinite {
        step, energy, q, ..
    }) = &error
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
