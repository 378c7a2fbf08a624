//! Observers of members are those of single runs.

use super::*;

#[test]
fn observers_of_members_are_those_of_single_runs() {
    let _level = one_level();
    let observer = |_: Member| (EnergyDrift::new(), every(3, Recorder::new()));
    let ending = |member: Member| {
        Events::new([Event::named("bottom").with_end_after(1 + member.index as u64 % 3)])
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
        assert_eq!(drift.1.inner().rows(), run.observer().1.inner().rows());
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

/// Observers that see every first, second or third state: neighbours, chunks and failures change no bit.
#[test]
fn intervals_of_neighbours_change_no_bit() {
    let interval = |member: Member| 1 + member.index as u64 % 3;
    let sweep = || {
        Sweep::new(COUNT, pendulum, StormerVerlet::default(), 0.05)
            .with_end_each(|member| 5.0 + part(member.index))
            .observe(move |member| every(interval(member), EnergyDrift::new()))
            .record(["t", "q", "p", "mean", "max"], |end| {
                let (State { t, q, p }, drift) = (end.state, end.observer.inner());
                [*t, q[0], p[0], drift.mean_relative(), drift.max_relative()]
            })
    };
    at_each_level(|cpu| {
        let all = rows(&sweep());
        for chunk in [1, 7] {
            assert_eq!(all, rows(&sweep().with_chunk(chunk)), "{cpu:?}");
        }
        let exact = rows(&sweep().reproducible());
        for (index, _, steps, values) in exact.iter().take(9) {
            let member = Member::new(*index, 0);
            let (system, start) = pendulum(member);
            let mut run = Integrator::new(&system, StormerVerlet::default(), start, 0.05)
                .expect("a good start")
                .observe(every(interval(member), EnergyDrift::new()));
            run.advance(*steps).expect("finite");
            let drift = run.observer().inner();
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
                .map(|one| one.inner().mean_relative().to_bits());
            drifts.collect::<Vec<_>>()
        };
        let many = swarm(COUNT);
        assert_eq!(many[..2], swarm(2), "{cpu:?}");
        assert_eq!(many[..1], swarm(1), "{cpu:?}");
    });
}
