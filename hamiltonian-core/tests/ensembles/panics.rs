//! A closure that panics is the error of its member, with the index.

use super::*;
use hamiltonian::Status;
use hamiltonian::View;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Panics for one member.
fn not(bad: usize, member: Member) {
    assert_ne!(member.index, bad, "the closure refuses it");
}

/// The errors that are there, each that of a panic.
fn panicked(errors: impl Iterator<Item = (usize, Option<String>)>) -> Vec<usize> {
    let mut found = vec![];
    for (index, error) in errors {
        let Some(error) = error else { continue };
        let begins = format!("member {index}: a closure panicked:");
        assert!(error.starts_with(&begins), "{error}");
        assert!(error.contains("the closure refuses it"), "{error}");
        found.push(index);
    }
    found
}

fn watching(bad: usize, member: Member) -> impl Observer<f64, Pendulum> + Send {
    watch(move |view: &View<'_, f64, Pendulum>| {
        if view.steps == 3 {
            not(bad, member);
        }
    })
}

#[test]
fn closures_of_an_ensemble() {
    let _level = one_level();
    let make = |member: Member| {
        not(5, member);
        pendulum(member)
    };
    let swarm = Ensemble::new(COUNT, make, StormerVerlet::default(), 0.1).expect("members");
    let mut seen = vec![];
    let mut swarm = swarm.reproducible().with_threads(2).observe(|member| {
        seen.push(member.index);
        not(7, member);
        // Of the observers of one chunk none can be made.
        assert!(!(80..160).contains(&member.index), "the closure refuses it");
        (watching(9, member), every(2, Recorder::new()))
    });
    swarm.advance(10);
    let errors = swarm
        .states()
        .map(|end| end.err().map(|error| error.to_string()));
    let bad: Vec<usize> = [5, 7, 9].into_iter().chain(80..160).collect();
    assert_eq!(panicked(errors.enumerate()), bad);
    // The others are what they would be alone, and have their own observers.
    assert!((0..COUNT).all(|index| seen.contains(&index)));
    for (index, (_, recorder)) in swarm.observers().enumerate() {
        if bad.contains(&index) {
            continue;
        }
        let (system, start) = pendulum(Member::new(index, 0));
        let mut run = Integrator::new(&system, StormerVerlet::default(), start, 0.1)
            .expect("a good start")
            .observe(every(2, Recorder::new()));
        let expected = run.advance(10).expect("finite").clone();
        let found = swarm.state_of(index).expect("a member").expect("finite");
        assert_eq!(bits(&found), bits(&expected), "member {index}");
        assert_eq!(recorder.inner().rows(), 6);
        let rows = recorder.inner().iter().flatten();
        assert!(
            rows.eq(run.observer().inner().iter().flatten()),
            "member {index}"
        );
    }
}

#[test]
fn closures_of_a_sweep() {
    let _level = one_level();
    let sweep = || {
        let make = |member: Member| {
            not(5, member);
            pendulum(member)
        };
        Sweep::new(COUNT, make, StormerVerlet::default(), 0.1)
            .with_end_each(|member| {
                not(6, member);
                1.5
            })
            .with_step_each(|member| {
                not(8, member);
                0.1
            })
            .observe(|member| {
                not(7, member);
                watching(9, member)
            })
            .with_chunk(20)
            .with_threads(2)
    };
    let errors = |mut all: Vec<_>, row: &hamiltonian::Row<'_>| {
        assert_eq!(row.error.is_some(), row.status == Status::Panicked);
        all.push((row.index, row.error.map(ToString::to_string)));
        all
    };
    let one = sweep().record(["q"], |end| {
        not(10, end.member);
        [end.state.q[0]]
    });
    let found = one.fold(vec![], errors).expect("there are members");
    assert_eq!(panicked(found.into_iter()), [5, 6, 7, 8, 9, 10]);
    let any = sweep().record_rows(["q"], |end| {
        not(11, end.member);
        [[end.state.q[0]]; 2]
    });
    let found = any.fold(vec![], errors).expect("there are members");
    assert_eq!(panicked(found.into_iter()), [5, 6, 7, 8, 9, 11]);
    let at = sweep().record_at([1.1, 1.6, 2.4], ["q"], |end| {
        if end.state.t > 1.5 {
            not(12, end.member);
        }
        [end.state.q[0]]
    });
    let found = at.fold(vec![], errors).expect("there are members");
    // Member 12 has the row of the first time.
    let mut bad = panicked(found.into_iter());
    bad.dedup();
    assert_eq!(bad, [5, 6, 7, 8, 9, 12]);
}

#[test]
fn chunks_written_before_a_panic_are_intact() {
    let _level = one_level();
    let sweep = || {
        Sweep::new(COUNT, pendulum, StormerVerlet::default(), 0.02)
            .with_steps(50)
            .with_chunk(20)
            .with_threads(2)
            .record(["q", "p"], |end| [end.state.q[0], end.state.p[0]])
    };
    let (disturbed, calm) = (place("panicked"), place("calm"));
    sweep().store(&calm).expect("a store");
    // A closure that is no member's ends the sweep.
    let panics = sweep().with_progress(|done, _| assert!(done < 60, "enough"));
    let store = AssertUnwindSafe(|| panics.store(&disturbed));
    assert!(catch_unwind(store).is_err());
    let left = sweep().completeness(&disturbed).expect("a store");
    assert_eq!(left.to_string(), "8 of 11 chunks are missing: 3 to 10");
    let (written, all) = (files(&disturbed), files(&calm));
    let chunks = written.iter().filter(|(path, _)| path.starts_with("q/c"));
    assert_eq!(chunks.count(), 3);
    for (path, bytes) in written.iter().filter(|(path, _)| !is_part(path)) {
        assert_eq!(all.get(path), Some(bytes), "{}", path.display());
    }
    assert!(sweep().store(&disturbed).expect("a store").is_complete());
    assert!(files(&disturbed) == all, "the stores differ");
    // A closure of a member is a row of it; other rows are as they would be.
    let panics = Sweep::new(
        COUNT,
        |member| {
            not(30, member);
            pendulum(member)
        },
        StormerVerlet::default(),
        0.02,
    );
    let panics = panics.with_steps(50).with_chunk(20).with_threads(2);
    let panics = panics.record(["q", "p"], |end| [end.state.q[0], end.state.p[0]]);
    let path = place("member");
    assert!(panics.store(&path).expect("a store").is_complete());
    for (file, bytes) in files(&path) {
        let of_chunk = file
            .components()
            .nth(2)
            .is_some_and(|part| part.as_os_str() == "1");
        if !of_chunk {
            assert_eq!(all.get(&file), Some(&bytes), "{}", file.display());
        }
    }
    let status = std::fs::read(path.join("status/c/1")).expect("a chunk");
    let mut expected = [1; 20];
    expected[10] = Status::Panicked as u8;
    assert_eq!(status, expected);
    for path in [&disturbed, &calm, &path] {
        std::fs::remove_dir_all(path).expect("it is there");
    }
}

/// Returns true for a file that was being written.
fn is_part(path: &std::path::Path) -> bool {
    path.components().any(|part| part.as_os_str() == "parts")
}
