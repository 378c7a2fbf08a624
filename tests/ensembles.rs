//! Ensembles and sweeps: every member is what a single run of it is.

use hamiltonian::Status;
use hamiltonian::lanes::Cpu;
use hamiltonian::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{PoisonError, RwLock};

hamiltonian! {
    /// A pendulum whose weight sways.
    pub struct Pendulum { l = 1.0, g = 1.0, a = 0.2 }
    H(q; p; t) = p^2/(2*l^2) - g*l*(1 + a*cos(3*t))*cos(q);
    monitor angular = p;
    event bottom = q
}

hamiltonian! {
    /// Hénon–Heiles.
    pub struct HenonHeiles { e = 1.0 }
    H(x, y; u, v) = (u^2 + v^2)/2 + (x^2 + y^2)/2 + e*(x^2*y - y^3/3)
}

hamiltonian! {
    /// Not separable, with exact flows.
    pub struct Mixture { a = 0.5 }
    H(q; p) = a*(q^2 + 1)*(p^2 + 1)
}

hamiltonian! {
    /// A chain whose length is set at run time.
    pub struct Chain { n: usize, m = 1.0 }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/(2*m) + exp(q[i] - q[(i + 1) % n]) }
}

hamiltonian! {
    /// A particle in a hole, where its potential ends.
    pub struct Hole { k = 1.0 }
    H(q; p) = p^2/2 + k*sqrt(q)
}

/// More than a pack of the widest level, and no multiple of one.
const COUNT: usize = 203;

fn part(index: usize) -> f64 {
    (index as f64 + 0.5) / COUNT as f64
}

fn pendulum(member: Member) -> (Pendulum, StateOf<Pendulum>) {
    let at = part(member.index);
    let system = Pendulum {
        l: 1.0 + 0.3 * at,
        ..Default::default()
    };
    (system, State::new([2.0 * at - 1.0], [0.4 - at]).at(at))
}

fn henon_heiles(member: Member) -> (HenonHeiles, StateOf<HenonHeiles>) {
    let at = part(member.index);
    let system = HenonHeiles { e: 1.0 - 0.2 * at };
    (system, State::new([0.2 * at, 0.1], [0.1, 0.3 * at]))
}

fn mixture(member: Member) -> (Mixture, StateOf<Mixture>) {
    let at = part(member.index);
    (Mixture::default(), State::new([at], [0.5 - at]))
}

fn chain(member: Member) -> (Chain, StateOf<Chain>) {
    let at = part(member.index);
    let chain = Chain::new(5).expect("five sites");
    (
        chain,
        State::new(vec![at, 0.0, -at, 0.1, 0.2], vec![0.0, 0.3, at, 0.0, -0.1]),
    )
}

/// The bits of a state.
fn bits<V: hamiltonian::Vector<Scalar = f64>>(state: &State<V>) -> Vec<u64> {
    let numbers = state.q.components().chain(state.p.components());
    core::iter::once(state.t)
        .chain(numbers)
        .map(f64::to_bits)
        .collect()
}

/// Members of a reproducible ensemble, advanced in two calls on two threads, have the bits of single runs.
fn agrees<S, M>(make: fn(Member) -> (S, StateOf<S>), scheme: M)
where
    S: System<f64>,
    M: Ensembles<S>,
{
    let name = hamiltonian::Listed::entry(&scheme).to_string();
    let h = 0.03125;
    let mut swarm = Ensemble::new(COUNT, make, scheme.clone(), h)
        .expect("there are members")
        .reproducible()
        .threads(2);
    swarm.advance(7).advance(6);
    let mut members = 0;
    for (index, end) in swarm.states().enumerate() {
        let (system, start) = make(Member::new(index, 0));
        let mut run = Integrator::new(&system, scheme.clone(), start, h).expect("a good start");
        let expected = run.advance(13).expect("finite").clone();
        let found = end.expect("finite");
        assert_eq!(
            bits(&found),
            bits(&expected),
            "{name}, member {index}: {found:?} {expected:?}"
        );
        members += 1;
    }
    assert_eq!(members, COUNT);
}

/// Held to write while levels are hidden from this process, and to read by each test whose bits or whose
/// stores depend on the level.
static LEVEL: RwLock<()> = RwLock::new(());

/// Keeps the level of this process as it is.
fn one_level() -> std::sync::RwLockReadGuard<'static, ()> {
    LEVEL.read().unwrap_or_else(PoisonError::into_inner)
}

/// Runs a test on each level of this CPU.
fn at_each_level(test: impl Fn(Cpu)) {
    let _alone = LEVEL.write().unwrap_or_else(PoisonError::into_inner);
    for cpu in Cpu::available() {
        Cpu::limit_to(cpu);
        test(cpu);
    }
    Cpu::limit_to(Cpu::Avx512);
}

#[test]
fn members_have_the_bits_of_single_runs() {
    at_each_level(|_| {
        // `benches/catalogue.rs` does the same with every scheme.
        agrees(pendulum, StormerVerlet::default());
        agrees(pendulum, ImplicitMidpoint::default());
        agrees(henon_heiles, Gauss::<2>::default());
        agrees(mixture, Tao::default());
        agrees(
            mixture,
            TwoStepMidpoint {
                start: Start::SecondOrder,
            },
        );
        agrees(chain, StormerVerlet::default());
    });
}

#[test]
fn neither_threads_nor_calls_nor_neighbours_change_a_bit() {
    at_each_level(|cpu| {
        let ends = |count, threads, calls: &[u64]| {
            let mut swarm = Ensemble::new(count, pendulum, StormerVerlet::default(), 0.1)
                .expect("there are members")
                .threads(threads);
            for n in calls {
                swarm.advance(*n);
            }
            let ends = swarm.states().map(|end| bits(&end.expect("finite")));
            ends.collect::<Vec<_>>()
        };
        let all = ends(COUNT, 1, &[1500]);
        assert_eq!(all, ends(COUNT, 2, &[700, 1, 799]), "{cpu:?}");
        assert_eq!(all[..3], ends(3, 1, &[1500]), "{cpu:?}");
        let swarm = Ensemble::new(COUNT, pendulum, StormerVerlet::default(), 0.1)
            .expect("there are members");
        let mut other = swarm.clone();
        other.advance(1500);
        let one = other.at(77).expect("there is one").expect("finite");
        assert_eq!(all[77], bits(&one));
        assert_eq!(swarm.steps(), 0, "the clone is another ensemble");
    });
}

#[test]
fn a_failing_member_says_where_and_disturbs_nobody() {
    let holes = |member: Member| {
        // Every seventh falls into the hole; one starts outside of it.
        let q = match member.index {
            11 => -1.0,
            index if index % 7 == 0 => 0.5 + 0.1 * part(index),
            _ => 100.0,
        };
        (Hole::default(), State::new([q], [0.0]))
    };
    at_each_level(|_| {
        for fuses in [false, true] {
            let mut swarm = Ensemble::new(COUNT, holes, StormerVerlet::default(), 0.01)
                .expect("there are members");
            if !fuses {
                swarm = swarm.reproducible();
            }
            swarm.advance(900).advance(900);
            let mut failed = 0;
            for (index, end) in swarm.states().enumerate() {
                let (system, start) = holes(Member::new(index, 0));
                let single = Integrator::new(&system, StormerVerlet::default(), start, 0.01)
                    .and_then(|mut run| run.advance(1800).cloned());
                match (single, end) {
                    (Ok(expected), Ok(found)) => {
                        assert!((found.q[0] - expected.q[0]).abs() < 1e-10);
                        assert_eq!(swarm.steps_of(index), Some(1800));
                    }
                    (Err(expected), Err(Error::Member { index: of, error })) => {
                        failed += 1;
                        assert_eq!(of, index);
                        if !fuses {
                            // By text, since a NaN is not itself.
                            assert_eq!(error.to_string(), expected.to_string());
                        }
                        let same = match (&*error, &expected) {
                            (
                                Error::NotFinite {
                                    step: a, piece: c, ..
                                },
                                Error::NotFinite {
                                    step: b, piece: d, ..
                                },
                            ) => a.abs_diff(*b) <= 1 && c == d,
                            (Error::Values { .. }, Error::Values { .. }) => true,
                            _ => false,
                        };
                        assert!(same, "{error} {expected}");
                    }
                    (single, end) => panic!("member {index}: {end:?}, alone {single:?}"),
                }
            }
            assert!(failed > COUNT / 7);
        }
    });
}

#[test]
fn observers_of_members_are_those_of_single_runs() {
    let _level = one_level();
    let observer = |_: Member| (EnergyDrift::new(), every(3, Recorder::new()));
    let ending = |member: Member| {
        Events::new([Event::named("bottom").ending_after(1 + member.index as u64 % 3)])
    };
    let mut drifts = Ensemble::new(COUNT, pendulum, StormerVerlet::default(), 0.05)
        .expect("there are members")
        .reproducible()
        .observe(observer);
    let mut events = Ensemble::new(COUNT, pendulum, StormerVerlet::default(), 0.05)
        .expect("there are members")
        .reproducible()
        .observe(ending);
    drifts.advance(100).advance(33);
    events.advance(100).advance(33);
    let mut ended = 0;
    for (index, ((drift, events), end)) in drifts
        .observers()
        .zip(events.observers())
        .zip(events.states())
        .enumerate()
    {
        let member = Member::new(index, 0);
        let (system, start) = pendulum(member);
        let mut run = Integrator::new(&system, StormerVerlet::default(), start.clone(), 0.05)
            .expect("a good start")
            .observe(observer(member));
        run.advance(133).expect("finite");
        assert_eq!(drift.0, run.observer().0, "member {index}");
        assert_eq!(drift.1.inner.rows(), run.observer().1.inner.rows());
        let mut run = Integrator::new(&system, StormerVerlet::default(), start, 0.05)
            .expect("a good start")
            .observe(ending(member));
        run.advance(133).expect("finite");
        assert_eq!(events.located(), run.observer().located(), "member {index}");
        assert_eq!(bits(&end.expect("finite")), bits(run.state()));
        ended += u32::from(run.has_ended());
    }
    assert!(ended > 50, "events end {ended} members");
}

/// Steps that vary in time, in principle.
#[derive(Debug, Clone, Copy)]
struct Steady;

impl<V: hamiltonian::Vector> Density<V> for Steady {
    fn rate(&self, _: V::Scalar, _: &V, _: &V, _: &V, _: &V) -> V::Scalar {
        V::Scalar::zero()
    }
}

#[test]
fn members_reach_a_time_as_single_runs_do() {
    let _level = one_level();
    // One start for all; the events of some members end them on the way.
    let together = |member: Member| {
        let (system, start) = pendulum(member);
        (system, start.at(0.25))
    };
    let ending = |member: Member| {
        let ends = 1 + member.index as u64 % 4;
        Events::new([Event::named("bottom").ending_after(ends)])
    };
    let mut swarm = Ensemble::new(COUNT, together, StormerVerlet::default(), 0.0625)
        .expect("there are members")
        .reproducible()
        .observe(ending);
    let mut runs: Vec<_> = (0..COUNT)
        .map(|index| {
            let member = Member::new(index, 0);
            let (system, start) = together(member);
            Integrator::new(&system, StormerVerlet::default(), start, 0.0625)
                .expect("a good start")
                .observe(ending(member))
        })
        .collect();
    // On the grid, between two steps, twice in one step, and on.
    for t in [2.25, 2.31, 2.3105, 6.0] {
        let ends = swarm.advance_until(t).expect("ahead");
        let mut on_the_way = 0;
        for (end, run) in ends.zip(&mut runs) {
            let end = end.expect("finite");
            let expected = run.advance_until(t).expect("ahead");
            assert_eq!(bits(&end), bits(&expected));
            on_the_way += u32::from(end.t.to_bits() == t.to_bits());
        }
        assert!(on_the_way > 20, "{on_the_way} members are at t = {t}");
    }
    let steps = swarm.steps();
    assert!(
        matches!(swarm.advance_to(6.03), Err(Error::OffGrid { before, after, .. })
        if (before, after) == (6.0, 6.0625))
    );
    assert!(matches!(swarm.advance_to(1.0), Err(Error::Behind { .. })));
    assert!(matches!(
        swarm.advance_until(f64::NAN).map(|_| ()),
        Err(Error::Unreachable { .. })
    ));
    assert_eq!(swarm.steps(), steps);
    let reached = swarm.advance_to(7.0).expect("on the grid");
    assert_eq!(reached.steps(), steps + 16);

    let mut apart =
        Ensemble::new(COUNT, pendulum, StormerVerlet::default(), 0.1).expect("there are members");
    assert!(matches!(apart.advance_to(2.0), Err(Error::Apart { .. })));
    let varying = Paced {
        scheme: StormerVerlet::default(),
        density: Steady,
    };
    let mut varying = Ensemble::new(3, together, varying, 0.1).expect("there are members");
    assert!(matches!(
        varying.advance_until(2.0).map(|_| ()),
        Err(Error::Apart { .. })
    ));
}

/// Exponents of members in lanes have the bits of single tangents.
fn deviates<S, M>(make: fn(Member) -> (S, StateOf<S>), scheme: M, deviations: usize)
where
    S: System<f64> + System<Dual<f64>>,
    M: Ensembles<S, Dual<f64>>,
{
    let h = 0.0625;
    let exponents = |count, threads| {
        Lyapunov::new(count, make, scheme.clone(), h)
            .deviations(deviations)
            .steps(50)
            .every(8)
            .threads(threads)
            .reproducible()
            .collect()
            .expect("there are members")
    };
    let all = exponents(COUNT, 2);
    assert_eq!(all.len(), COUNT);
    for (index, found) in all.iter().enumerate() {
        let (system, start) = make(Member::new(index, 0));
        let expected = Tangent::new(&system, scheme.clone(), start, h, deviations)
            .and_then(|mut tangent| tangent.lyapunov(50, 8));
        match (found, expected) {
            (Ok(found), Ok(expected)) => assert_eq!(
                found.iter().map(|rate| rate.to_bits()).collect::<Vec<_>>(),
                expected
                    .iter()
                    .map(|rate| rate.to_bits())
                    .collect::<Vec<_>>(),
                "member {index}: {found:?} {expected:?}"
            ),
            (Err(Error::Member { index: of, error }), Err(expected)) => {
                assert_eq!((*of, error.to_string()), (index, expected.to_string()));
            }
            (found, expected) => panic!("member {index}: {found:?}, alone {expected:?}"),
        }
    }
    let few = exponents(3, 1).into_iter().map(Result::ok);
    assert!(few.eq(all.into_iter().take(3).map(Result::ok)));
}

#[test]
fn exponents_of_members_are_those_of_single_tangents() {
    let falling = |member: Member| {
        // Some fall into the hole on the way, one starts outside of it.
        let q = if member.index == 11 {
            -1.0
        } else {
            0.2 + 50.0 * part(member.index)
        };
        (Hole::default(), State::new([q], [0.0]))
    };
    at_each_level(|_| {
        deviates(henon_heiles, StormerVerlet::default(), 3);
        deviates(pendulum, Gauss::<2>::default(), 2);
        deviates(falling, StormerVerlet::default(), 1);
    });
    let _level = one_level();
    let of = || Lyapunov::new(2, mixture, ImplicitMidpoint::default(), 0.1);
    assert!(matches!(of().collect(), Err(Error::NoSteps)));
    let none = Lyapunov::new(0, mixture, ImplicitMidpoint::default(), 0.1).steps(1);
    assert!(matches!(none.collect(), Err(Error::NoMembers)));
    let many = of().steps(1).deviations(3).collect().expect("members");
    assert!(
        many.iter()
            .all(|one| matches!(one, Err(Error::Member { error, .. })
        if matches!(**error, Error::Deviations { most: 2, found: 3 })))
    );
    let stop = AtomicBool::new(true);
    let stopped = of().steps(1).cancel(&stop).collect();
    assert!(matches!(stopped, Err(Error::Cancelled { done: 0, of: 2 })));
}

/// Observers that see every first, second or third state: neighbours, chunks and failures change no bit.
#[test]
fn intervals_of_neighbours_change_no_bit() {
    let interval = |member: Member| 1 + member.index as u64 % 3;
    let sweep = || {
        Sweep::new(COUNT, pendulum, StormerVerlet::default(), 0.05)
            .until_each(|member| 5.0 + part(member.index))
            .observe(move |member| every(interval(member), EnergyDrift::new()))
            .record(["t", "q", "p", "mean", "max"], |end| {
                let (State { t, q, p }, drift) = (end.state, &end.observer.inner);
                [*t, q[0], p[0], drift.mean_relative(), drift.max_relative()]
            })
    };
    at_each_level(|cpu| {
        let all = rows(&sweep());
        for chunk in [1, 7] {
            assert_eq!(all, rows(&sweep().chunk(chunk)), "{cpu:?}");
        }
        let exact = rows(&sweep().reproducible());
        for (index, _, steps, values) in exact.iter().take(9) {
            let member = Member::new(*index, 0);
            let (system, start) = pendulum(member);
            let mut run = Integrator::new(&system, StormerVerlet::default(), start, 0.05)
                .expect("a good start")
                .observe(every(interval(member), EnergyDrift::new()));
            run.advance(*steps).expect("finite");
            let drift = &run.observer().inner;
            let expected = [drift.mean_relative(), drift.max_relative()];
            assert_eq!(values[3..], expected.map(f64::to_bits), "{cpu:?}, {index}");
        }
        // An ensemble that stops between two states that its members see.
        let swarm = |count: usize| {
            let mut swarm = Ensemble::new(count, pendulum, StormerVerlet::default(), 0.05)
                .expect("there are members")
                .observe(move |member| every(interval(member), EnergyDrift::new()));
            swarm.advance(50).advance(70);
            let drifts = swarm
                .observers()
                .map(|one| one.inner.mean_relative().to_bits());
            drifts.collect::<Vec<_>>()
        };
        let many = swarm(COUNT);
        assert_eq!(many[..2], swarm(2), "{cpu:?}");
        assert_eq!(many[..1], swarm(1), "{cpu:?}");
    });
}

#[test]
fn a_saved_ensemble_goes_on_with_the_same_bits() {
    let _level = one_level();
    let ensemble = || {
        Ensemble::new(COUNT, pendulum, StormerVerlet::default(), 0.05).expect("there are members")
    };
    let observer = |member: Member| {
        let ends = 1 + member.index as u64 % 3;
        let events = Events::new([Event::named("bottom").ending_after(ends)]);
        (EnergyDrift::new(), events)
    };
    let mut swarm = ensemble().observe(observer);
    swarm.advance(70);
    let saved = swarm.checkpoint().to_bytes();
    swarm.advance(63);
    let saved = || Checkpoint::from_bytes(&saved).expect("as it was saved");
    let resumed = Ensemble::resume(COUNT, pendulum, StormerVerlet::default(), saved());
    let mut again = resumed.expect("the same members").observe(observer);
    again.advance(63);
    for (index, (end, expected)) in again.states().zip(swarm.states()).enumerate() {
        assert_eq!(
            bits(&end.expect("finite")),
            bits(&expected.expect("finite"))
        );
        assert_eq!(again.steps_of(index), swarm.steps_of(index));
    }
    for (found, expected) in again.observers().zip(swarm.observers()) {
        assert_eq!(found.0, expected.0);
        assert_eq!(found.1.located(), expected.1.located());
    }
    let other = |member: Member| {
        let (system, start) = pendulum(member);
        (Pendulum { g: 2.0, ..system }, start)
    };
    let other = Ensemble::resume(COUNT, other, StormerVerlet::default(), saved());
    assert!(other.is_err_and(|error| error.to_string().contains("another parameter")));
    let fewer = Ensemble::resume(9, pendulum, StormerVerlet::default(), saved());
    assert!(fewer.is_err_and(|error| error.to_string().contains("9 members")));
}

/// Each row of a sweep, by bits.
fn rows<O: Observer<f64, Pendulum>>(
    sweep: &Sweep<'_, Pendulum, O, hamiltonian::Record<'_, Pendulum, O>>,
) -> Vec<(usize, Status, u64, Vec<u64>)> {
    let add = |mut all: Vec<_>, row: &hamiltonian::Row<'_>| {
        let values = row.values.iter().map(|value| value.to_bits()).collect();
        all.push((row.index, row.status, row.steps, values));
        all
    };
    sweep.fold(vec![], add).expect("there are members")
}

#[test]
fn a_sweep_has_the_bits_of_single_runs_whatever_its_layout() {
    // Ends and steps of each member: lanes change hands at different steps.
    let end = |member: Member| 3.0 + 2.0 * part(member.index);
    let step = |member: Member| 0.01 + 0.01 * part(COUNT - member.index);
    let sweep = || {
        Sweep::new(COUNT, pendulum, StormerVerlet::default(), 1.0)
            .until_each(end)
            .step_each(step)
            .observe(|_| EnergyDrift::new())
            .record(["t", "q", "p", "drift", "energy"], |end| {
                let State { t, q, p } = end.state;
                [*t, q[0], p[0], end.observer.max_relative(), end.energy()]
            })
    };
    at_each_level(|_| {
        let all = rows(&sweep().reproducible().threads(1));
        assert_eq!(all.len(), COUNT);
        for (index, status, steps, values) in &all {
            let member = Member::new(*index, 0);
            let (system, start) = pendulum(member);
            let mut run = Integrator::new(&system, StormerVerlet::default(), start, step(member))
                .expect("a good start")
                .observe(EnergyDrift::new());
            let state = run.advance_until(end(member)).expect("finite");
            let drift = run.observer().max_relative();
            let expected = [
                state.t,
                state.q[0],
                state.p[0],
                drift,
                system.energy(&state),
            ];
            assert_eq!(*values, expected.map(f64::to_bits), "member {index}");
            assert_eq!((*status, *steps), (Status::Ended, run.steps()));
        }
        let fused = rows(&sweep().threads(1));
        for chunk in [1, 7, 4096] {
            assert_eq!(all, rows(&sweep().reproducible().chunk(chunk).threads(2)));
            assert_eq!(fused, rows(&sweep().chunk(chunk).threads(2)));
        }
        let mut sharded = vec![];
        for k in 0..7 {
            let shard = Shard::new(k, 7).expect("a shard");
            sharded.extend(rows(&sweep().chunk(8).shard(shard)));
        }
        sharded.sort_by_key(|row| row.0);
        assert_eq!(fused, sharded);
    });
}

#[test]
fn sweeps_record_at_times_and_sections() {
    let _level = one_level();
    let times = [0.0, 0.011, 0.012, 0.5, 2.0];
    let start = |member: Member| (Pendulum::default(), State::new([part(member.index)], [0.3]));
    let sweep = Sweep::new(COUNT, start, StormerVerlet::default(), 0.02).reproducible();
    let table = sweep
        .record_at(times, ["t", "q"], |end| [end.state.t, end.state.q[0]])
        .collect()
        .expect("rows");
    assert_eq!(
        (table.rows(), table.columns()[0].as_str()),
        (COUNT * times.len(), "member")
    );
    for (k, row) in table.iter().enumerate() {
        let (index, time) = (k / times.len(), times[k % times.len()]);
        let (system, start) = start(Member::new(index, 0));
        let mut run =
            Integrator::new(&system, StormerVerlet::default(), start, 0.02).expect("a good start");
        let expected = run.advance_until(time).expect("finite");
        assert_eq!(row, [index as f64, expected.t, expected.q[0]]);
    }
    let section = Sweep::new(40, start, StormerVerlet::default(), 0.02)
        .steps(1000)
        .observe(|_| Events::new([Event::named("bottom").rising()]))
        .rows(["t", "p"], |end| {
            end.observer
                .states("bottom")
                .map(|state| [state.t, state.p[0]])
                .collect::<Vec<_>>()
        })
        .collect()
        .expect("rows");
    assert!(section.rows() > 40 * 2);
    assert!(section.column("p").is_some_and(|mut p| p.all(|p| p > 0.0)));
}

#[test]
fn bad_input_is_a_typed_error() {
    let _level = one_level();
    let none = Ensemble::new(0, pendulum, StormerVerlet::default(), 0.1);
    assert!(matches!(none, Err(Error::NoMembers)));
    assert!(matches!(
        Ensemble::new(3, pendulum, StormerVerlet::default(), 0.0),
        Err(Error::Step { .. })
    ));
    let none = Sweep::new(0, pendulum, StormerVerlet::default(), 0.1)
        .steps(1)
        .record(["q"], |end| [end.state.q[0]]);
    assert!(matches!(none.collect(), Err(Error::NoMembers)));

    let panics = |member: Member| {
        assert_ne!(member.index, 5, "no member {}", member.index);
        pendulum(member)
    };
    let sweep = Sweep::new(20, panics, StormerVerlet::default(), 0.1)
        .steps(10)
        .record(["q"], |end| {
            assert_ne!(end.member.index, 7, "no record");
            [end.state.q[0]]
        });
    let errors = |all: Vec<_>, row: &hamiltonian::Row<'_>| {
        let error = row
            .error
            .map(|error| (row.status, row.values[0].is_nan(), error.to_string()));
        all.into_iter().chain(error).collect()
    };
    let errors = sweep.fold(vec![], errors).expect("there are members");
    assert_eq!(errors.len(), 2);
    assert!(
        errors
            .iter()
            .all(|(status, is_nan, _)| *status == Status::Panicked && *is_nan)
    );
    assert!(
        errors[0].2.starts_with("member 5: a closure panicked:")
            && errors[0].2.contains("no member 5"),
        "{}",
        errors[0].2
    );
    assert!(errors[1].2.starts_with("member 7: a closure panicked:"));

    let sizes = |member: Member| {
        let n = if member.index == 2 { 4 } else { 3 };
        Ok((Chain::new(n)?, State::new(vec![0.1; n], vec![0.2; n])))
    };
    let mut swarm =
        Ensemble::try_new(4, sizes, StormerVerlet::default(), 0.1).expect("there are members");
    swarm.advance(3);
    let failed: Vec<bool> = swarm.states().map(|end| end.is_err()).collect();
    assert_eq!(failed, [false, false, true, false]);

    let flag = AtomicBool::new(false);
    let sweep = Sweep::new(1000, pendulum, StormerVerlet::default(), 0.1)
        .steps(10)
        .chunk(10)
        .cancel(&flag)
        .record(["q"], |end| {
            if end.member.index == 500 {
                flag.store(true, Ordering::Relaxed);
            }
            [end.state.q[0]]
        });
    let cancelled = sweep.collect();
    assert!(
        matches!(cancelled, Err(Error::Cancelled { done, of: 1000 }) if (400..1000).contains(&done))
    );
}

#[test]
fn a_store_goes_on_where_it_stopped() {
    let _level = one_level();
    let path = std::env::temp_dir().join(format!("hamiltonian-sweep-{}.zarr", std::process::id()));
    let _ = std::fs::remove_dir_all(&path);
    let sweep = |seed| {
        Sweep::new(COUNT, pendulum, StormerVerlet::default(), 0.01)
            .steps(50)
            .chunk(16)
            .seed(seed)
            .record(["q", "p"], |end| [end.state.q[0], end.state.p[0]])
    };
    let shard = |k| Shard::new(k, 3).expect("a shard");
    let first = sweep(1).shard(shard(1)).store(&path).expect("a store");
    assert!(!first.is_complete());
    assert!(
        !sweep(1)
            .shard(shard(0))
            .store(&path)
            .expect("a store")
            .is_complete()
    );
    assert!(sweep(1).store(&path).expect("a store").is_complete());
    let again = sweep(1).store(&path).expect("nothing is left to do");
    assert!(again.is_complete());
    assert!(sweep(2).store(&path).is_err(), "a store of another sweep");
    let moved = |member: Member| {
        let (system, start) = pendulum(member);
        (system, start.at(0.5))
    };
    let other = Sweep::new(COUNT, moved, StormerVerlet::default(), 0.01)
        .steps(50)
        .chunk(16)
        .seed(1);
    let other = other.record(["q", "p"], |end| [end.state.q[0], end.state.p[0]]);
    assert!(other.store(&path).is_err(), "a store of other members");
    std::fs::remove_dir_all(&path).expect("it is there");
}

/// The sweep of the processes that are killed: slow enough to be caught at work.
fn killed(
    shard: Shard,
) -> Sweep<'static, Pendulum, (), hamiltonian::Record<'static, Pendulum, ()>> {
    Sweep::new(4_000, pendulum, StormerVerlet::default(), 0.001)
        .steps(2_000)
        .chunk(20)
        .shard(shard)
        .threads(1)
        .reproducible()
        .record(["q", "p"], |end| [end.state.q[0], end.state.p[0]])
}

/// The child process of the test below; it does nothing else.
#[test]
fn a_process_that_is_killed() {
    if let Some(path) = std::env::var_os("HAMILTONIAN_TEST_STORE") {
        let shard = Shard::from_env().expect("a shard");
        killed(shard).store(path).expect("a store");
    }
}

/// All files of a directory, with their bytes.
fn files(root: &std::path::Path) -> std::collections::BTreeMap<std::path::PathBuf, Vec<u8>> {
    let mut all = std::collections::BTreeMap::new();
    let mut left = vec![root.to_owned()];
    while let Some(directory) = left.pop() {
        for entry in std::fs::read_dir(directory).expect("a directory") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                left.push(path);
            } else {
                let name = path.strip_prefix(root).expect("inside").to_owned();
                all.insert(name, std::fs::read(path).expect("a file"));
            }
        }
    }
    all
}

#[test]
fn killed_processes_lose_and_double_nothing() {
    let _level = one_level();
    let heavy = std::env::var_os("HAMILTONIAN_HEAVY").is_some();
    let kills = if heavy { 100 } else { 10 };
    let place = |name: &str| {
        std::env::temp_dir().join(format!("hamiltonian-{name}-{}.zarr", std::process::id()))
    };
    let (disturbed, whole) = (place("disturbed"), place("whole"));
    for path in [&disturbed, &whole] {
        let _ = std::fs::remove_dir_all(path);
    }
    let start = |shard: u32| {
        std::process::Command::new(std::env::current_exe().expect("this test"))
            .args(["a_process_that_is_killed", "--exact"])
            .env("HAMILTONIAN_TEST_STORE", &disturbed)
            .env("HAMILTONIAN_SHARD", format!("{shard}/2"))
            .stdout(std::process::Stdio::null())
            .spawn()
            .expect("a process")
    };
    for kill in 0..kills {
        let mut children = [start(0), start(1)];
        std::thread::sleep(std::time::Duration::from_millis(20 + 37 * kill % 100));
        for child in &mut children {
            child.kill().expect("it is ours");
            child.wait().expect("it was killed");
        }
    }
    for mut child in [start(0), start(1)] {
        assert!(child.wait().expect("it ends").success());
    }
    let all = Shard::new(0, 1).expect("a shard");
    assert!(
        killed(all)
            .store(&disturbed)
            .expect("a store")
            .is_complete()
    );
    killed(all).store(&whole).expect("a store");
    assert!(files(&disturbed) == files(&whole), "the stores differ");
    for path in [&disturbed, &whole] {
        std::fs::remove_dir_all(path).expect("it is there");
    }
}
