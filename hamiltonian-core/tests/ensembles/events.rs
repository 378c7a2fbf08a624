//! Events of members, which lanes follow, are those of single runs.

use super::*;
use hamiltonian::Scheme;
use hamiltonian::Status;
use hamiltonian::errors::SweepError;
use hamiltonian::schemes::author::{Map, Scratch, Step};
use std::f64::consts::TAU;

/// Members that librate and members that turn over.
fn swinging(member: Member) -> (Pendulum, StateOf<Pendulum>) {
    let at = part(member.index);
    let system = Pendulum {
        l: 1.0 - 0.3 * at,
        ..Default::default()
    };
    (system, State::new([2.0 * at - 1.0], [4.0 * at - 1.5]))
}

/// What members look for: neighbours look for different functions, from different sides, to different ends.
fn sought(member: Member) -> Events<hamiltonian::private::SVector<f64, 1>> {
    let bottom = || Event::named("bottom");
    let count = 1 + member.index as u64 % 5;
    match member.index % 7 {
        0 => Events::new([bottom()]),
        1 => Events::new([bottom().with_direction(1)]),
        2 => Events::new([Event::named("angular").with_direction(-1), bottom()]),
        3 => Events::new([bottom().with_period(TAU), Event::named("angular")]),
        4 => Events::new([bottom()
            .with_period(1.5)
            .with_direction(1)
            .with_end_after(count)]),
        5 => Events::new([Event::named("angular").with_end_after(count)]),
        // A closure is seen member by member.
        _ => Events::new([Event::of("level", |state: &StateOf<Pendulum>| {
            state.q[0] - 0.3
        })]),
    }
}

#[test]
#[ignore = "many steps: `.ci/run` makes them"]
fn events_of_members_are_those_of_single_runs() {
    // Long steps: functions come near 0 and turn within two of them. Closing pieces move momenta, or coordinates.
    events_are_those_of_single_runs(StormerVerlet::KickDriftKick, [0.03, 0.9]);
    events_are_those_of_single_runs(StormerVerlet::DriftKickDrift, [0.7, -0.2]);
}

fn events_are_those_of_single_runs<const KICK_FIRST: bool>(
    scheme: StormerVerlet<KICK_FIRST>,
    steps: [f64; 2],
) {
    // More than the lanes of a level, and not a multiple of them.
    const COUNT: usize = 67;
    for step in steps {
        // Single runs find the same on every level.
        let single: Vec<_> = (0..COUNT)
            .map(|index| {
                let member = Member::new(index, 0);
                let (system, start) = swinging(member);
                let mut run = Integrator::new(&system, scheme, start, step)
                    .expect("a good start")
                    .observe((sought(member), every(1, Monitors::new())));
                let end = bits(run.advance(1501).expect("finite"));
                let (events, monitors) = run.observer();
                (events.clone(), monitors.clone(), end, run.steps())
            })
            .collect();
        at_each_level(|cpu| {
            let mut swarm = Ensemble::new(COUNT, swinging, scheme, step)
                .expect("there are members")
                .reproducible()
                .observe(|member| (sought(member), every(1, Monitors::new())));
            swarm.advance(400).advance(1).advance(1100);
            let mut found = 0;
            let ends = swarm.observers().zip(swarm.states()).zip(&single);
            for (index, (((events, monitors), end), single)) in ends.enumerate() {
                let place = format!("{cpu:?}, step {step}, member {index}");
                assert_eq!(events.located(), single.0.located(), "{place}");
                assert_eq!(monitors.inner(), single.1.inner(), "{place}");
                assert_eq!(bits(&end.expect("finite")), single.2, "{place}");
                assert_eq!(swarm.steps_of(index), Some(single.3), "{place}");
                found += events.located().len();
            }
            assert!(found > 300, "{found} events");
        });
    }
}

#[test]
fn closing_pieces_and_observables_are_of_the_halves_they_name() {
    let (system, start) = swinging(Member::new(3, 0));
    let declared = &system.description().observables;
    assert_eq!(
        [declared[0].reads, declared[1].reads],
        [[false, true], [true, false]]
    );
    let prepared = System::prepare::<f64>(&system);
    macro_rules! moves {
        ($($scheme:expr => $moves:expr),+ $(,)?) => {$(
            let (scheme, moves) = ($scheme, $moves);
            let map = Scheme::<Pendulum>::prepare(&scheme, &prepared, Step::of(0.1));
            let mut carried = Scheme::<Pendulum>::start(&scheme, &prepared, &start, 0.1);
            let mut work = Scratch::like(&carried);
            map.step(0.0, 0.1, &mut carried, &mut work);
            let before = carried.clone();
            map.close(0.1, &mut carried, &mut work);
            assert_eq!(map.closing(), moves, "{scheme:?}");
            assert_eq!([carried.q != before.q, carried.p != before.p], moves, "{scheme:?}");
        )+};
    }
    moves! {
        StormerVerlet::KickDriftKick => [false, true],
        StormerVerlet::DriftKickDrift => [true, false],
    }
}

#[test]
#[ignore = "many steps: `.ci/run` makes them"]
fn neighbours_of_events_change_no_bit() {
    const COUNT: usize = 67;
    let sweep = || {
        Sweep::new(COUNT, swinging, BlanesMoan4, 0.05)
            .with_end_each(|member| 20.0 + 30.0 * part(member.index))
            .observe(sought)
            .record_rows(["event", "t", "q", "p"], |end| {
                let located = end.observer.located().iter().map(|located| {
                    let State { t, q, p } = &located.state;
                    [located.event as f64, *t, q[0], p[0]]
                });
                let State { t, q, p } = end.state;
                located.chain([[-1.0, *t, q[0], p[0]]]).collect::<Vec<_>>()
            })
    };
    at_each_level(|cpu| {
        let all = rows(&sweep());
        let stopped = all.iter().filter(|row| row.1 == Status::Stopped).count();
        assert!(all.len() > 300 && stopped > 15, "{} {stopped}", all.len());
        for chunk in [1, 7] {
            assert_eq!(all, rows(&sweep().with_chunk(chunk)), "{cpu:?}");
        }
        assert_eq!(
            all,
            rows(&sweep().with_threads(2).with_chunk(20)),
            "{cpu:?}"
        );
    });
}

hamiltonian! {
    /// A particle that falls past a mark into a hole, where its potential ends.
    pub struct Marked { k = 1.0 }
    H(q; p) = p^2/2 + k*sqrt(q);
    event mark = q - 0.3
}

#[test]
fn events_before_a_failure_are_found_once() {
    // Every third falls past the mark; every sixth ends there, before it would fail.
    let falls = |member: Member| {
        let q = if member.index.is_multiple_of(3) {
            0.5
        } else {
            90.0
        };
        (
            Marked::default(),
            State::new([q + 0.1 * part(member.index)], [0.0]),
        )
    };
    let marks = |member: Member| {
        let mark = Event::named("mark");
        Events::new([if member.index.is_multiple_of(6) {
            mark.with_end_after(1)
        } else {
            mark
        }])
    };
    at_each_level(|cpu| {
        let mut swarm = Ensemble::new(COUNT, falls, StormerVerlet::default(), 0.01)
            .expect("there are members")
            .reproducible()
            .observe(marks);
        swarm.advance(900);
        for (index, (events, end)) in swarm.observers().zip(swarm.states()).enumerate() {
            let (system, start) = falls(Member::new(index, 0));
            let mut run = Integrator::new(&system, StormerVerlet::default(), start, 0.01)
                .expect("a good start")
                .observe(marks(Member::new(index, 0)));
            let expected = run.advance(900).cloned();
            let place = format!("{cpu:?}, member {index}");
            assert_eq!(events.located(), run.observer().located(), "{place}");
            assert_eq!(
                events.located().len(),
                usize::from(index.is_multiple_of(3)),
                "{place}"
            );
            assert_eq!(end.is_err(), index % 6 == 3, "{place}");
            match (end, expected) {
                (Ok(end), Ok(expected)) => assert_eq!(bits(&end), bits(&expected), "{place}"),
                (Err(Error::Sweep(SweepError::Member { error, .. })), Err(expected)) => {
                    assert_eq!(error.to_string(), expected.to_string(), "{place}");
                }
                (end, expected) => panic!("{place}: {end:?}, alone {expected:?}"),
            }
        }
    });
}

hamiltonian! {
    /// Free motion past marks, many of them at the ends of steps.
    pub struct Passing { a = 0.25, b = 0.5, c = 0.75, k = 0.0 }
    H(q; p) = p^2/2 + k*q;
    event marks = (q - a)*(q - b)*(q - c);
    event pole = (q - a)/(q - b);
    event turn = q*(q - c)
}

/// A member that passes marks: three of the cubic, in units of a step from its start. Roots that are not after steps
/// are in steps of their own; two marks may be equal.
struct Passed {
    marks: [f64; 3],
    forward: bool,
}

/// The number of steps of a member, and their size. With p = ±1, every q is exact.
const STEPS: u64 = 20;
const STEP: f64 = 0.25;

impl Passed {
    fn new(member: Member) -> Self {
        let mut seed = member.seed;
        let mut below = |n: u64| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 33) % n
        };
        let first = below(STEPS - 3);
        let steps = [first, first + 1, first + 2 + below(STEPS - first - 2)];
        let mut marks = steps.map(|step| match below(3) {
            0 => step as f64 + (1 + below(98)) as f64 / 100.0,
            _ => step as f64,
        });
        match below(4) {
            0 => marks[1] = marks[0],
            1 => marks.reverse(),
            _ => {}
        }
        Passed {
            marks,
            forward: below(2) == 0,
        }
    }

    /// The direction and the place of a mark.
    fn place(&self, mark: f64) -> f64 {
        if self.forward {
            STEP * mark
        } else {
            STEP * (STEPS as f64 - mark)
        }
    }

    fn member(&self) -> (Passing, StateOf<Passing>) {
        let [a, b, c] = self.marks.map(|mark| self.place(mark));
        let system = Passing {
            a,
            b,
            c,
            ..Default::default()
        };
        let p = if self.forward { 1.0 } else { -1.0 };
        (system, State::new([self.place(0.0)], [p]))
    }

    /// (q − a)·(q − b)·(q − c) after a number of steps, up to a positive factor.
    fn cubic(&self, at: f64) -> f64 {
        let sign = if self.forward { 1.0 } else { -1.0 };
        self.marks
            .iter()
            .fold(sign, |product, mark| product * (at - mark))
    }

    /// The events of `marks`, `pole` and `turn` in order: the index, the direction, the number of steps until then.
    fn expected(&self, rising: bool) -> Vec<(usize, bool, f64)> {
        let [a, b, c] = self.marks;
        let mut all = Vec::new();
        for mark in [a, b, c] {
            let beside = 1e-6;
            let (before, after) = (self.cubic(mark - beside), self.cubic(mark + beside));
            let is_seen = all.iter().any(|(_, _, at)| *at == mark);
            if before * after < 0.0 && !is_seen && (!rising || after > 0.0) {
                all.push((0, after > 0.0, mark));
            }
        }
        if a != b {
            // (q − a)/(q − b)
            all.push((1, a > b, a));
        }
        // q·(q − c)
        all.push((2, self.forward, c));
        all.retain(|(_, _, at)| *at > 0.0 && *at < STEPS as f64);
        all
    }
}

#[test]
fn zeros_on_steps_are_found_in_lanes() {
    const MEMBERS: usize = 330;
    let sought = |member: Member| {
        let marks = Event::named("marks");
        let is_rising = member.index.is_multiple_of(5);
        Events::new([
            if is_rising {
                marks.with_direction(1)
            } else {
                marks
            },
            Event::named("pole"),
            Event::named("turn"),
        ])
    };
    at_each_level(|cpu| {
        let passing = |member| Passed::new(member).member();
        let mut swarm = Ensemble::new(MEMBERS, passing, StormerVerlet::default(), STEP)
            .expect("there are members")
            .reproducible()
            .observe(sought);
        swarm.advance(STEPS);
        let (mut found, mut on_steps, mut missed) = (0, 0, 0);
        for (index, events) in swarm.observers().enumerate() {
            let member = Member::new(index, 0);
            let passed = Passed::new(member);
            let (system, start) = passed.member();
            let mut run = Integrator::new(&system, StormerVerlet::default(), start, STEP)
                .expect("a good start")
                .observe(sought(member));
            run.advance(STEPS).expect("finite");
            let place = format!("{cpu:?}, member {index}: {system:?}");
            assert_eq!(events.located(), run.observer().located(), "{place}");
            let located = events.located().iter();
            let mut located: Vec<_> = located
                .map(|found| (found.event, found.rising, found.state.t / STEP))
                .collect();
            let mut expected = passed.expected(index.is_multiple_of(5));
            let order = |a: &(usize, bool, f64), b: &(usize, bool, f64)| {
                a.0.cmp(&b.0).then(a.2.total_cmp(&b.2))
            };
            located.sort_by(order);
            expected.sort_by(order);
            let is_near = |(a, b): (&(usize, bool, f64), &(usize, bool, f64))| {
                (a.0, a.1) == (b.0, b.1) && (a.2 - b.2).abs() < 1e-9
            };
            assert!(
                located.len() == expected.len() && located.iter().zip(&expected).all(is_near),
                "{place}\n{located:?}\n{expected:?}"
            );
            // Control: signs after steps alone.
            let signs = (0..=STEPS)
                .map(|k| passed.cubic(k as f64))
                .filter(|value| *value != 0.0);
            let signs: Vec<bool> = signs.map(|value| value > 0.0).collect();
            let changes = signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
            missed += usize::from(
                changes
                    != passed
                        .expected(false)
                        .iter()
                        .filter(|event| event.0 == 0)
                        .count(),
            );
            found += expected.len();
            on_steps += expected
                .iter()
                .filter(|(_, _, at)| at.fract() == 0.0)
                .count();
        }
        assert!(
            found > 900 && on_steps > 500 && missed > 50,
            "{found} {on_steps} {missed}"
        );
    });
}
