//! Stores of sweeps outlast processes.

use super::*;
use hamiltonian::Status;
use hamiltonian::errors::StoreError;

#[test]
fn a_store_goes_on_where_it_stopped() {
    let _level = one_level();
    let path = place("sweep");
    let sweep = |seed| {
        Sweep::new(COUNT, pendulum, StormerVerlet::default(), 0.01)
            .with_steps(50)
            .with_chunk(16)
            .with_seed(seed)
            .record(["q", "p"], |end| [end.state.q[0], end.state.p[0]])
    };
    let shard = |k| Shard::new(k, 3).expect("a shard");
    let first = sweep(1).with_shard(shard(1)).store(&path).expect("a store");
    assert!(!first.is_complete());
    assert!(
        !sweep(1)
            .with_shard(shard(0))
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
        .with_steps(50)
        .with_chunk(16)
        .with_seed(1);
    let other = other.record(["q", "p"], |end| [end.state.q[0], end.state.p[0]]);
    assert!(other.store(&path).is_err(), "a store of other members");
    std::fs::remove_dir_all(&path).expect("it is there");
}

#[test]
fn shards_of_two_levels_share_a_reproducible_store_alone() {
    let _alone = LEVEL.write().unwrap_or_else(PoisonError::into_inner);
    let shard = |k| Shard::new(k, 2).expect("a shard");
    let sweep = || {
        Sweep::new(COUNT, pendulum, StormerVerlet::default(), 0.01)
            .with_steps(50)
            .with_chunk(16)
            .record(["q", "p"], |end| [end.state.q[0], end.state.p[0]])
    };
    let levels: Vec<Cpu> = Cpu::available().collect();
    let [worst, best] = [levels[0], levels[levels.len() - 1]];
    let (fused, unfused, calm) = (place("fused"), place("unfused"), place("calm-levels"));
    Cpu::limit_to(worst);
    let first = sweep().with_shard(shard(0)).store(&fused).expect("a store");
    assert!(!first.is_complete());
    sweep()
        .reproducible()
        .with_shard(shard(0))
        .store(&unfused)
        .expect("a store");
    Cpu::limit_to(best);
    let (second, opened) = (
        sweep().with_shard(shard(1)).store(&fused),
        sweep().completeness(&fused),
    );
    let last = sweep().reproducible().with_shard(shard(1)).store(&unfused);
    sweep().reproducible().store(&calm).expect("a store");
    Cpu::limit_to(Cpu::Avx512);
    if worst == best {
        return;
    }
    for refused in [second, opened] {
        let Err(Error::Store(StoreError::Other { saved, given, .. })) = refused else {
            panic!("{refused:?}");
        };
        assert_eq!(&*saved, format!("\"level\": \"{worst:?}\""));
        assert_eq!(&*given, format!("\"level\": \"{best:?}\""));
    }
    assert!(last.expect("a store").is_complete());
    let read = std::fs::read_to_string(unfused.join("zarr.json")).expect("a store");
    for attribute in [
        "\"level\": \"any\"",
        "\"scheme\": \"StormerVerlet (kick-drift-kick): KickDriftKick\"",
    ] {
        assert!(read.contains(attribute), "{read}");
    }
    assert!(files(&unfused) == files(&calm), "the stores differ");
    for path in [&fused, &unfused, &calm] {
        std::fs::remove_dir_all(path).expect("it is there");
    }
}

#[test]
fn members_that_failed_are_stored_with_the_kind_of_their_failure() {
    let _level = one_level();
    let path = place("failed");
    let sweep = Sweep::try_new(20, holes, StormerVerlet::default(), 0.01)
        .with_end(17.0)
        .with_chunk(20)
        .record(["q", "p"], |end| [end.state.q[0], end.state.p[0]]);
    assert_eq!(
        sweep
            .completeness(&path)
            .expect("nothing is wrong")
            .to_string(),
        "1 of 1 chunks are missing: 0"
    );
    assert!(!path.exists(), "asking creates a store");
    assert!(sweep.store(&path).expect("a store").is_complete());
    let kind = |index: usize| match index {
        11 | 13 => Status::Start,
        index if index % 7 == 0 => Status::NotFinite,
        _ => Status::Ended,
    };
    let status = std::fs::read(path.join("status/c/0")).expect("a chunk");
    assert!(
        status
            .iter()
            .copied()
            .eq((0..20).map(|index| kind(index) as u8))
    );
    for column in ["q", "p", "time"] {
        let bytes = std::fs::read(path.join(column).join("c/0")).expect("a chunk");
        let numbers = bytes.as_chunks::<8>().0.iter();
        for (index, number) in numbers.map(|bytes| f64::from_le_bytes(*bytes)).enumerate() {
            let has_none = match column {
                // That of the last good step.
                "time" => kind(index) == Status::Start,
                _ => kind(index) != Status::Ended,
            };
            assert_eq!(number.is_nan(), has_none, "{column} of member {index}");
        }
    }
    std::fs::remove_dir_all(&path).expect("it is there");
}

/// The sweep of the processes that are killed: slow enough to be caught at work.
fn killed(
    shard: Shard,
) -> Sweep<
    'static,
    Pendulum,
    StormerVerlet,
    (),
    hamiltonian::Record<'static, Pendulum, ()>,
    hamiltonian::Unfused,
> {
    Sweep::new(4_000, pendulum, StormerVerlet::default(), 0.001)
        .with_steps(2_000)
        .with_chunk(20)
        .with_shard(shard)
        .with_threads(1)
        .reproducible()
        .record(["q", "p"], |end| [end.state.q[0], end.state.p[0]])
}

const PLACE: &str = "HAMILTONIAN_TEST_STORE";

/// The child process of the test below; it does nothing else.
#[test]
fn a_process_that_is_killed() {
    if let Some(path) = std::env::var_os(PLACE) {
        let shard = Shard::from_env().expect("a shard");
        killed(shard).store(path).expect("a store");
    }
}

#[test]
#[ignore = "many steps: `.ci/run` makes them"]
fn killed_processes_lose_and_double_nothing() {
    let _level = one_level();
    let (disturbed, whole) = (place("disturbed"), place("whole"));
    let start = |shard: u32| {
        std::process::Command::new(std::env::current_exe().expect("this test"))
            .args(["stores::a_process_that_is_killed", "--exact"])
            .env(PLACE, &disturbed)
            .env("HAMILTONIAN_SHARD", format!("{shard}/2"))
            .stdout(std::process::Stdio::null())
            .spawn()
            .expect("a process")
    };
    // The chunks that are there: only the processes write any.
    let present = || {
        let chunks = std::fs::read_dir(disturbed.join("status/c"));
        chunks.map_or(0, Iterator::count)
    };
    let all = Shard::new(0, 1).expect("a shard");
    let chunks = 4_000 / 20;
    let (mut kills, mut rounds, mut written) = (0, 0, 0);
    while kills < 100 {
        rounds += 1;
        assert!(rounds < 1_000, "{kills} of {rounds} processes were at work");
        if present() == chunks {
            // They were faster than the kills: once more from the beginning.
            std::fs::remove_dir_all(&disturbed).expect("it is there");
        }
        let before = present();
        let mut children = [start(0), start(1)];
        let begun = std::time::Instant::now();
        let is_due = || present() > before || begun.elapsed().as_secs() > 60;
        while !is_due() && children.iter_mut().any(is_at_work) {
            std::thread::yield_now();
        }
        // Not always at the moment when a chunk has appeared.
        std::thread::sleep(std::time::Duration::from_micros(rounds * 37 % 5_000));
        for child in &mut children {
            child.kill().expect("it is ours");
            let ended = child.wait().expect("it was killed");
            // One that had come to its end was not killed.
            kills += u32::from(!ended.success() && present() > before);
        }
        written += present() - before;
    }
    assert!(written >= 50, "{written} chunks of {rounds} rounds");
    for mut child in [start(0), start(1)] {
        assert!(child.wait().expect("it ends").success());
    }
    let complete = killed(all).completeness(&disturbed).expect("a store");
    assert!(complete.is_complete(), "{complete}");
    killed(all).store(&whole).expect("a store");
    assert!(files(&disturbed) == files(&whole), "the stores differ");
    for path in [&disturbed, &whole] {
        std::fs::remove_dir_all(path).expect("it is there");
    }
}

/// Returns true if a process has not come to its end.
fn is_at_work(child: &mut std::process::Child) -> bool {
    child.try_wait().expect("it is ours").is_none()
}
