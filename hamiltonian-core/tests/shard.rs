//! The part of a sweep that the environment names, for every launcher.

use hamiltonian_core::{Error, Shard};
use std::process::Command;

/// The outcome for these variables, `NAME=value` each.
fn found(variables: &str) -> Result<String, String> {
    let lookup = |name: &str| {
        let set = variables.split_whitespace();
        let mut pairs = set.map(|pair| pair.split_once('=').unwrap());
        pairs
            .find(|(set, _)| *set == name)
            .map(|(_, value)| value.to_string())
    };
    Shard::from_lookup(lookup)
        .map(|shard| shard.to_string())
        .map_err(|error| error.to_string())
}

/// Asserts the part.
fn is(variables: &str, shard: &str) {
    assert_eq!(found(variables).as_deref(), Ok(shard), "{variables}");
}

/// Asserts an error that begins so.
fn refused(variables: &str, message: &str) {
    let error = found(variables).expect_err(variables);
    assert!(error.starts_with(message), "{variables}: {error}");
}

const ARRAY: &str = "SLURM_ARRAY_TASK_MIN=1 SLURM_ARRAY_TASK_MAX=9 SLURM_ARRAY_TASK_STEP=2 \
    SLURM_ARRAY_TASK_COUNT=5";

#[test]
fn each_launcher_is_understood() {
    is("", "0/1");
    is("HAMILTONIAN_SHARD=2/7", "2/7");
    is("OMPI_COMM_WORLD_RANK=1 OMPI_COMM_WORLD_SIZE=2", "1/2");
    is("PMI_RANK=0 PMI_SIZE=3", "0/3");
    for (id, shard) in [(1, "0/5"), (3, "1/5"), (9, "4/5")] {
        is(&format!("SLURM_ARRAY_TASK_ID={id} {ARRAY}"), shard);
    }
    is("SLURM_STEP_ID=0 SLURM_PROCID=3 SLURM_NTASKS=4", "3/4");
    is(
        "SLURM_STEP_ID=0 SLURM_PROCID=3 SLURM_NTASKS=4 SLURM_STEP_NUM_TASKS=4",
        "3/4",
    );
    is("HQ_TASK_ID=4 HAMILTONIAN_SHARDS=5", "4/5");
}

#[test]
fn a_batch_script_is_no_task_of_srun() {
    is("SLURM_PROCID=0 SLURM_NTASKS=4", "0/1");
    // The step of a batch script.
    is(
        "SLURM_STEP_ID=4294967291 SLURM_PROCID=0 SLURM_NTASKS=4",
        "0/1",
    );
}

/// Every source before the next, whose variables are there as well.
#[test]
fn the_first_source_counts() {
    let sources = [
        ("HAMILTONIAN_SHARD=1/11".to_string(), "1/11"),
        (
            "OMPI_COMM_WORLD_RANK=2 OMPI_COMM_WORLD_SIZE=12".to_string(),
            "2/12",
        ),
        ("PMI_RANK=3 PMI_SIZE=13".to_string(), "3/13"),
        (format!("SLURM_ARRAY_TASK_ID=5 {ARRAY}"), "2/5"),
        (
            "SLURM_STEP_ID=0 SLURM_PROCID=5 SLURM_NTASKS=15".to_string(),
            "5/15",
        ),
        ("HQ_TASK_ID=6 HAMILTONIAN_SHARDS=16".to_string(), "6/16"),
    ];
    for first in 0..sources.len() {
        let set: Vec<&str> = sources[first..]
            .iter()
            .map(|(set, _)| set.as_str())
            .collect();
        is(&set.join(" "), sources[first].1);
    }
}

#[test]
fn contradictions_are_errors() {
    refused(
        "HAMILTONIAN_SHARD=2/2",
        "shard 2/2 (from `HAMILTONIAN_SHARD`) does not exist\nhelp: ",
    );
    for text in [
        "",
        "1",
        "1/",
        "/2",
        "a/b",
        "-1/2",
        "+1/2",
        "1/2/3",
        "0/99999999999999999999",
    ] {
        refused(
            &format!("HAMILTONIAN_SHARD={text}"),
            &format!("`HAMILTONIAN_SHARD` is `{text}`, and must be `k/n`"),
        );
    }
    refused("HAMILTONIAN_SHARD=0/0", "shard 0/0 ");
    for (rank, size) in [
        ("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"),
        ("PMI_RANK", "PMI_SIZE"),
    ] {
        let missing = |set, not| format!("`{set}` is set, but `{not}` is not");
        refused(&format!("{rank}=0"), &missing(rank, size));
        refused(&format!("{size}=2"), &missing(size, rank));
        refused(&format!("{rank}=2 {size}=2"), "shard 2/2 ");
        refused(
            &format!("{rank}=zero {size}=2"),
            &format!("`{rank}` is `zero`"),
        );
        refused(&format!("{rank}=0 {size}="), &format!("`{size}` is ``"));
        refused(&format!("{rank}=0 {size}=0"), "shard 0/0 ");
        // A source that is broken is not passed over.
        refused(
            &format!("{rank}=0 HQ_TASK_ID=0 HAMILTONIAN_SHARDS=2"),
            &missing(rank, size),
        );
    }
    refused(
        "SLURM_ARRAY_TASK_ID=1",
        "`SLURM_ARRAY_TASK_ID` is set, but `SLURM_ARRAY_TASK_MIN` is not",
    );
    refused(
        &format!("SLURM_ARRAY_TASK_ID=0 {ARRAY}"),
        "`SLURM_ARRAY_TASK_ID=0` contradicts ",
    );
    refused(
        &format!("SLURM_ARRAY_TASK_ID=2 {ARRAY}"),
        "`SLURM_ARRAY_TASK_ID=2` contradicts ",
    );
    refused(&format!("SLURM_ARRAY_TASK_ID=11 {ARRAY}"), "shard 5/5 ");
    let uneven = ARRAY.replace("COUNT=5", "COUNT=3");
    refused(
        &format!("SLURM_ARRAY_TASK_ID=1 {uneven}"),
        "`SLURM_ARRAY_TASK_MAX=9` contradicts `SLURM_ARRAY_TASK_COUNT=3`: the tasks are not evenly spaced",
    );
    let standing = ARRAY.replace("STEP=2", "STEP=0");
    refused(
        &format!("SLURM_ARRAY_TASK_ID=1 {standing}"),
        "`SLURM_ARRAY_TASK_ID=1` contradicts ",
    );
    refused(
        "SLURM_STEP_ID=0",
        "`SLURM_STEP_ID` is set, but `SLURM_PROCID` is not",
    );
    refused(
        "SLURM_STEP_ID=0 SLURM_PROCID=1",
        "`SLURM_STEP_ID` is set, but `SLURM_NTASKS` is not",
    );
    refused(
        "SLURM_STEP_ID=0 SLURM_PROCID=1 SLURM_NTASKS=4 SLURM_STEP_NUM_TASKS=2",
        "`SLURM_NTASKS=4` contradicts `SLURM_STEP_NUM_TASKS=2`",
    );
    refused(
        "SLURM_STEP_ID=0 SLURM_PROCID=4 SLURM_NTASKS=4",
        "shard 4/4 ",
    );
    refused(
        "HQ_TASK_ID=0",
        "`HQ_TASK_ID` is set, but `HAMILTONIAN_SHARDS` is not\nhelp: ",
    );
    refused(
        "HAMILTONIAN_SHARDS=4",
        "`HAMILTONIAN_SHARDS` is set, but `HQ_TASK_ID` is not\nhelp: ",
    );
    // An array from 1, as `--array 1-5`.
    refused(
        "HQ_TASK_ID=5 HAMILTONIAN_SHARDS=5",
        "shard 5/5 (from `HQ_TASK_ID`) does not exist",
    );
}

#[test]
fn parts_are_disjoint_and_together_the_whole() {
    for count in [1, 2, 7] {
        for chunk in 0..20 {
            let owners = (0..count).filter(|k| Shard::new(*k, count).unwrap().has(chunk));
            assert_eq!(owners.count(), 1);
        }
    }
    assert_eq!(Shard::default(), Shard::WHOLE);
    assert!(matches!(Shard::new(0, 0), Err(Error::Shard(_))));
    assert!(matches!(Shard::new(7, 7), Err(Error::Shard(_))));
}

/// The environment of a process of its own: this test, run by itself.
#[test]
fn the_environment_is_read() {
    const INSIDE: &str = "HAMILTONIAN_TEST_OF_SHARDS";
    if let Ok(shard) = std::env::var(INSIDE) {
        assert_eq!(Shard::from_env().unwrap().to_string(), shard);
        return;
    }
    let run = |shard: &str| {
        let this = std::env::current_exe().unwrap();
        Command::new(this)
            .args(["--exact", "shard::the_environment_is_read"])
            .env("HAMILTONIAN_SHARD", "4/9")
            .env(INSIDE, shard)
            .output()
            .unwrap()
    };
    let output = run("4/9");
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(
        output.status.success() && text.contains("1 passed"),
        "{text}"
    );
    // The test inside fails for another part.
    assert!(!run("0/1").status.success());
}
