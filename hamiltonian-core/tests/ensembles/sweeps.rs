//! Sweeps: rows of members, and errors.

use super::*;
use hamiltonian::Status;
use hamiltonian::errors::{StartError, SweepError};
use std::sync::atomic::{AtomicBool, Ordering};

#[test]
fn a_sweep_has_the_bits_of_single_runs_whatever_its_layout() {
    // Ends and steps of each member: lanes change hands at different steps.
    let end = |member: Member| 3.0 + 2.0 * part(member.index);
    let step = |member: Member| 0.05 + 0.05 * part(COUNT - member.index);
    let sweep = || {
        Sweep::new(COUNT, pendulum, StormerVerlet::default(), 1.0)
            .with_end_each(end)
            .with_step_each(step)
            .observe(|_| EnergyDrift::new())
            .record(["t", "q", "p", "drift", "energy"], |end| {
                let State { t, q, p } = end.state;
                [*t, q[0], p[0], end.observer.max_relative(), end.energy()]
            })
    };
    let alone = |index| {
        let member = Member::new(index, 0);
        let (system, start) = pendulum(member);
        let mut run = Integrator::new(&system, StormerVerlet::default(), start, step(member))
            .expect("a good start")
            .observe(EnergyDrift::new());
        let state = run.advance_until(end(member)).expect("finite");
        let drift = run.observer().max_relative();
        let energy = system.energy(&state);
        let values = [state.t, state.q[0], state.p[0], drift, energy];
        let values = values.map(f64::to_bits).to_vec();
        (index, Status::Ended, run.steps(), values)
    };
    let expected: Vec<_> = (0..COUNT).map(alone).collect();
    at_each_level(|cpu| {
        let all = rows(&sweep().reproducible().with_threads(1));
        assert_eq!(all.len(), COUNT);
        for (found, expected) in all.iter().zip(&expected) {
            assert_eq!(found, expected);
        }
        let fused = rows(&sweep().with_threads(1));
        for &chunk in chunks(cpu) {
            assert_eq!(
                all,
                rows(&sweep().reproducible().with_chunk(chunk).with_threads(2))
            );
            assert_eq!(fused, rows(&sweep().with_chunk(chunk).with_threads(2)));
        }
        let mut sharded = vec![];
        for k in 0..7 {
            let shard = Shard::new(k, 7).expect("a shard");
            sharded.extend(rows(&sweep().with_chunk(8).with_shard(shard)));
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
        let ended = f64::from(Status::Ended as u8);
        assert_eq!(row, [index as f64, expected.t, expected.q[0], ended]);
    }
    let section = Sweep::new(40, start, StormerVerlet::default(), 0.02)
        .with_steps(1000)
        .observe(|_| Events::new([Event::named("bottom").with_direction(1)]))
        .record_rows(["t", "p"], |end| {
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
    assert!(matches!(
        none,
        Err(Error::Sweep(SweepError::NoMembers { .. }))
    ));
    assert!(matches!(
        Ensemble::new(3, pendulum, StormerVerlet::default(), 0.0),
        Err(Error::Start(StartError::Step { .. }))
    ));
    let none = Sweep::new(0, pendulum, StormerVerlet::default(), 0.1)
        .with_steps(1)
        .record(["q"], |end| [end.state.q[0]]);
    assert!(matches!(
        none.collect(),
        Err(Error::Sweep(SweepError::NoMembers { .. }))
    ));

    let panics = |member: Member| {
        assert_ne!(member.index, 5, "no member {}", member.index);
        pendulum(member)
    };
    let sweep = Sweep::new(20, panics, StormerVerlet::default(), 0.1)
        .with_steps(10)
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
        .with_steps(10)
        .with_chunk(10)
        .with_cancel(&flag)
        .record(["q"], |end| {
            if end.member.index == 500 {
                flag.store(true, Ordering::Relaxed);
            }
            [end.state.q[0]]
        });
    let cancelled = sweep.collect();
    assert!(
        matches!(cancelled, Err(Error::Sweep(SweepError::Cancelled { done, of: 1000, .. })) if (400..1000).contains(&done))
    );
}
