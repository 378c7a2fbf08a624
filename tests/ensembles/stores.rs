//! Stores of sweeps outlast processes.

use super::*;

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
