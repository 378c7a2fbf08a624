//! Rows of sweeps with failing members among them, and where a sweep stops: whatever the layout.

use super::*;
use hamiltonian::Status;
use hamiltonian::errors::SweepError;
use hamiltonian::{Rounding, Unfused};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

/// The index of each row, its member's end and its bits, its member's error.
type Rows = Vec<(usize, Status, u64, Vec<u64>, Option<String>)>;

fn with_errors<S: System, M: Scheme<S>, A: Rounding>(
    sweep: &Sweep<'_, S, M, (), hamiltonian::Record<'_, S, ()>, A>,
) -> Rows {
    let add = |mut all: Rows, row: &hamiltonian::Row<'_>| {
        let numbers = row.values.iter().chain([&row.time]);
        let bits = numbers.map(|number| number.to_bits()).collect();
        let error = row.error.map(ToString::to_string);
        all.push((row.index, row.status, row.steps, bits, error));
        all
    };
    sweep.fold(vec![], add).expect("there are members")
}

#[test]
fn failing_members_change_no_bit_whatever_the_layout() {
    let sweep = || {
        Sweep::try_new(COUNT, holes, StormerVerlet::default(), 0.04)
            .with_end_each(|member| 5.0 + 2.0 * part(COUNT - member.index))
    };
    at_each_level(|cpu| {
        changes_no_bit(cpu, sweep);
        changes_no_bit(cpu, || sweep().reproducible());
    });
}

fn changes_no_bit<'a, A: Rounding>(
    cpu: Cpu,
    sweep: impl Fn() -> Sweep<'a, Hole, StormerVerlet, (), (), A>,
) {
    let recorded = |sweep: Sweep<'a, Hole, StormerVerlet, (), (), A>| {
        sweep.record(["t", "q", "p"], |end| {
            [end.state.t, end.state.q[0], end.state.p[0]]
        })
    };
    let all = with_errors(&recorded(sweep()).with_threads(1));
    assert_eq!(all.len(), COUNT);
    let mut failed = 0;
    for (index, status, .., error) in &all {
        let expected = match index {
            11 | 13 => Status::Start,
            index if index % 7 == 0 => Status::NotFinite,
            _ => Status::Ended,
        };
        assert_eq!(*status, expected, "{cpu:?}, member {index}: {error:?}");
        assert_eq!(error.is_some(), expected != Status::Ended);
        failed += u32::from(error.is_some());
    }
    assert!(failed > 30, "{failed} failed");
    for &chunk in chunks(cpu) {
        let other = with_errors(&recorded(sweep()).with_chunk(chunk).with_threads(2));
        assert!(all == other, "{cpu:?}, chunks of {chunk}: {other:?}");
    }
    let mut sharded = vec![];
    for k in 0..7 {
        let shard = Shard::new(k, 7).expect("a shard");
        sharded.extend(with_errors(
            &recorded(sweep()).with_chunk(8).with_shard(shard),
        ));
    }
    sharded.sort_by_key(|row| row.0);
    assert!(all == sharded, "{cpu:?}, shards: {sharded:?}");
}

#[test]
fn an_early_stop_does_not_depend_on_the_layout() {
    let _level = one_level();
    let sweep = || {
        Sweep::new(COUNT, pendulum, StormerVerlet::default(), 0.02)
            .with_steps(100)
            .reproducible()
            .record(["q"], |end| [end.state.q[0]])
    };
    // The index at which a sum that depends on the order passes a limit, and the sum.
    let stopped = |sweep: &Sweep<
        '_,
        Pendulum,
        StormerVerlet,
        (),
        hamiltonian::Record<'_, Pendulum, ()>,
        Unfused,
    >,
                   limit| {
        let mut is_over = false;
        let found = sweep.try_fold((0, 0.0), |(_, sum), row| {
            assert!(!is_over, "a row after the stop");
            let sum = 0.9 * sum + row.values[0].abs();
            is_over = sum > limit;
            match is_over {
                true => ControlFlow::Break((row.index, sum)),
                false => ControlFlow::Continue((row.index, sum)),
            }
        });
        let (index, sum) = found.expect("there are members");
        (index, sum.to_bits())
    };
    let mut sums = vec![];
    sweep()
        .fold(0.0, |sum: f64, row| {
            sums.push(0.9 * sum + row.values[0].abs());
            sums[row.index]
        })
        .expect("there are members");
    // Limits that are passed at the first row, within, and never.
    for limit in [-1.0, 0.5, 2.0, f64::INFINITY] {
        let first = sums
            .iter()
            .position(|sum| *sum > limit)
            .unwrap_or(COUNT - 1);
        let expected = (first, sums[first].to_bits());
        for chunk in [1, 7, 4096] {
            for threads in [1, 2] {
                let found = stopped(&sweep().with_chunk(chunk).with_threads(threads), limit);
                assert_eq!(found, expected, "chunks of {chunk} on {threads} threads");
            }
        }
    }
    assert!(sums.iter().any(|sum| *sum > 2.0));
}

#[test]
fn a_long_member_is_cancelled_on_its_way() {
    let _level = one_level();
    for (count, threads) in [(1, 1), (1, 2), (40, 2)] {
        let flag = AtomicBool::new(false);
        // Some minutes if nobody cancels them.
        let sweep = Sweep::new(count, pendulum, StormerVerlet::default(), 1e-9)
            .with_steps(10_000_000_000)
            .with_chunk(20)
            .with_threads(threads)
            .with_cancel(&flag)
            .record(["q"], |end| [end.state.q[0]]);
        let ended = std::thread::scope(|scope| {
            scope.spawn(|| {
                std::thread::sleep(std::time::Duration::from_millis(50));
                flag.store(true, Ordering::Relaxed);
            });
            sweep.collect()
        });
        assert!(
            matches!(ended, Err(Error::Sweep(SweepError::Cancelled { done: 0, of, .. })) if of == count)
        );
    }
}

#[test]
fn a_sweep_has_an_end() {
    let _level = one_level();
    let has_no_end = |error| matches!(error, Some(Error::Sweep(SweepError::NoEnd { .. })));
    let sweep = || Sweep::new(3, pendulum, StormerVerlet::default(), 0.1);
    let none = sweep().record(["q"], |end| [end.state.q[0]]);
    assert!(has_no_end(none.collect().err()));
    assert!(has_no_end(none.fold(0, |n, _| n + 1).err()));
    let path = place("no-end");
    assert!(has_no_end(none.store(&path).err()));
    assert!(has_no_end(none.completeness(&path).err()));
    assert!(!path.exists());
    let none = sweep().record_at([], ["q"], |end| [end.state.q[0]]);
    assert!(has_no_end(none.collect().err()));
    // An end at the start is one.
    let starts = sweep().with_steps(0).record(["q"], |end| [end.state.q[0]]);
    let starts = starts.collect().expect("rows");
    let expected = (0..3).map(|index| pendulum(Member::new(index, 0)).1.q[0]);
    assert!(starts.column("q").expect("a column").eq(expected));
}
