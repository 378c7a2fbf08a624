//! Members at times, and saved on their way.

use super::*;
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
    let varying = Paced::new(StormerVerlet::default(), Steady);
    let mut varying = Ensemble::new(3, together, varying, 0.1).expect("there are members");
    assert!(matches!(
        varying.advance_until(2.0).map(|_| ()),
        Err(Error::Sweep(SweepError::Apart { .. }))
    ));
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
