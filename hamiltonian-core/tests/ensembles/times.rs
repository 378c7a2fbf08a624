//! Members at times, and saved on their way.

use super::*;
use hamiltonian::schemes::Adaptive;
use hamiltonian_core::VectorOf;
use hamiltonian_core::errors::{SweepError, TimeError};

/// Steps that vary in time, in principle.
#[derive(Debug, Clone, Copy)]
struct Steady;

impl<S: System> Density<S> for Steady {
    fn rate<T: Real>(
        &self,
        _: T,
        _: &VectorOf<S, T>,
        _: &VectorOf<S, T>,
        _: &VectorOf<S, T>,
        _: &VectorOf<S, T>,
    ) -> T {
        T::zero()
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
        Events::new([Event::named("bottom").with_end_after(ends)])
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
        matches!(swarm.advance_to(6.03), Err(Error::Time(TimeError::OffGrid { before, after, .. }))
        if (before, after) == (6.0, 6.0625))
    );
    assert!(matches!(
        swarm.advance_to(1.0),
        Err(Error::Time(TimeError::Behind { .. }))
    ));
    assert!(matches!(
        swarm.advance_until(f64::NAN).map(|_| ()),
        Err(Error::Time(TimeError::Unreachable { .. }))
    ));
    assert_eq!(swarm.steps(), steps);
    let reached = swarm.advance_to(7.0).expect("on the grid");
    assert_eq!(reached.steps(), steps + 16);

    let mut apart =
        Ensemble::new(COUNT, pendulum, StormerVerlet::default(), 0.1).expect("there are members");
    assert!(matches!(
        apart.advance_to(2.0),
        Err(Error::Sweep(SweepError::Apart { .. }))
    ));
}

/// Members whose steps vary in time have a time in common, and the bits of single runs: their states there, their events on
/// the way, and what they do afterwards.
#[test]
fn members_with_steps_of_their_own_reach_a_time() {
    let _level = one_level();
    reach(Adaptive::new(GaussNystrom::<8>::default(), 1e-9), 1.0);
    reach(Paced::new(StormerVerlet::default(), Steady), 0.0625);
}

/// More than the lanes of a pack.
const FEW: usize = 20;

fn reach<M: Scheme<Pendulum> + Copy>(scheme: M, step: f64) {
    // Each from a time of its own.
    let own = |member: Member| {
        let (system, start) = pendulum(member);
        (system, start.at(0.01 * member.index as f64))
    };
    let observer = |member: Member| {
        let ends = 2 + member.index as u64 % 4;
        let events = Events::new([Event::named("bottom").with_end_after(ends)]);
        (
            events,
            every(1 + member.index as u64 % 3, EnergyDrift::new()),
        )
    };
    let ensemble = || {
        let swarm = Ensemble::new(FEW, own, scheme, step).expect("there are members");
        swarm.reproducible()
    };
    let mut swarm = ensemble().observe(observer);
    assert!(matches!(
        swarm.advance_to(2.0),
        Err(Error::Sweep(SweepError::Apart { .. }))
    ));
    assert!(matches!(
        swarm.advance_until(f64::INFINITY).map(|_| ()),
        Err(Error::Time(TimeError::Unreachable { .. }))
    ));
    let mut runs: Vec<_> = (0..FEW)
        .map(|index| {
            let member = Member::new(index, 0);
            let (system, start) = own(member);
            Integrator::new(&system, scheme, start, step)
                .expect("a good start")
                .observe(observer(member))
        })
        .collect();
    swarm.advance(3);
    for run in &mut runs {
        run.advance(3).expect("finite");
    }
    let mut saved = None;
    for t in [5.25, 5.31, 5.3105, 7.0] {
        let ends = swarm.advance_until(t).expect("ahead");
        let mut on_the_way = 0;
        for (end, run) in ends.zip(&mut runs) {
            let end = end.expect("finite");
            let expected = run.advance_until(t).expect("ahead");
            assert_eq!(bits(&end), bits(&expected));
            on_the_way += u32::from(end.t.to_bits() == t.to_bits());
        }
        assert!(on_the_way > 8, "{on_the_way} members are at t = {t}");
        saved.get_or_insert_with(|| swarm.checkpoint());
    }
    let steps = |run: &Integrator<_, _, _, _>| run.steps();
    let most = runs.iter().filter(|run| !run.has_ended()).map(steps).max();
    assert_eq!(Some(swarm.steps()), most);
    assert!(runs.iter().map(steps).min() < most);
    // The saved members do the same once more.
    let checkpoint = Checkpoint::from_bytes(&saved.expect("saved").to_bytes()).expect("as saved");
    let resumed = Ensemble::resume_reproducible(FEW, own, scheme, checkpoint);
    let mut resumed = resumed.expect("the same members").observe(observer);
    assert!(
        resumed
            .advance_until(7.0)
            .expect("ahead")
            .all(|end| end.is_ok())
    );
    for swarm in [&mut swarm, &mut resumed] {
        swarm.advance(7);
    }
    for (index, run) in runs.iter_mut().enumerate() {
        run.advance(7).expect("finite");
        for swarm in [&swarm, &resumed] {
            let end = swarm.state_of(index).and_then(Result::ok).expect("finite");
            assert_eq!(bits(&end), bits(run.state()));
            assert_eq!(swarm.steps_of(index), Some(run.steps()));
        }
    }
    for swarm in [&swarm, &resumed] {
        for (found, run) in swarm.observers().zip(&runs) {
            assert_eq!(found.0.located(), run.observer().0.located());
            assert_eq!(format!("{:?}", found.1), format!("{:?}", run.observer().1));
        }
    }
}

#[test]
fn a_saved_ensemble_goes_on_with_the_same_bits() {
    let _level = one_level();
    let ensemble = || {
        Ensemble::new(COUNT, pendulum, StormerVerlet::default(), 0.05).expect("there are members")
    };
    let observer = |member: Member| {
        let ends = 1 + member.index as u64 % 3;
        let events = Events::new([Event::named("bottom").with_end_after(ends)]);
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
    // Another arithmetic has other bits.
    let scheme = StormerVerlet::default();
    let exact = Ensemble::resume_reproducible(COUNT, pendulum, scheme, saved());
    assert!(exact.is_err_and(|error| error.to_string().contains("another arithmetic")));
    let mut exact = ensemble().reproducible();
    exact.advance(70);
    let half = Checkpoint::from_bytes(&exact.checkpoint().to_bytes()).expect("as it was saved");
    exact.advance(63);
    let again = Ensemble::resume_reproducible(COUNT, pendulum, scheme, half);
    let mut again = again.expect("the same members");
    again.advance(63);
    assert!(again.states().eq(exact.states()));
    let fewer = Ensemble::resume(9, pendulum, StormerVerlet::default(), saved());
    assert!(fewer.is_err_and(|error| error.to_string().contains("9 members")));
}
