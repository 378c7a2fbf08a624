//! The recorded bits of runs, next to the version of saved runs.
//!
//! Input: a word for each run, in which all its bits count. Output: none; a panic names the runs that differ from the
//! record. Invariant: recorded words change only together with the version, so that a saved run is never continued with
//! other bits.

use hamiltonian_core::Checkpoint;
use std::collections::BTreeMap;
use std::path::Path;

/// A word in which each byte of a saved run counts, apart from the version and the checksum.
pub fn word(saved: &Checkpoint) -> u64 {
    let bytes = saved.to_bytes();
    bytes[16..bytes.len() - 8]
        .iter()
        .fold(0, |word: u64, byte| {
            let mixed = (word ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3);
            mixed.rotate_left(17)
        })
}

/// The version of saved runs in their bytes.
fn version(saved: &Checkpoint) -> u64 {
    let bytes = saved.to_bytes();
    u64::from_le_bytes(*bytes[8..].first_chunk().expect("a header"))
}

/// The record with these words, or why they may not be recorded.
fn renewed(record: &str, version: u64, found: &BTreeMap<String, u64>) -> Result<String, String> {
    let mut lines = record.lines();
    let known = lines.next().and_then(|line| line.strip_prefix("version "));
    if known.is_some_and(|known| known == version.to_string()) {
        let changed = |line: &&str| {
            let (word, name) = line.split_once(' ').unwrap_or_default();
            (found.get(name)).is_some_and(|found| format!("{found:016x}") != word)
        };
        let changed: Vec<&str> = lines.filter(changed).collect();
        if !changed.is_empty() {
            return Err(format!(
                "the bits of these runs changed, and the version of saved runs is still {version}:\n{}\nhelp: raise \
                 `VERSION` in `hamiltonian-core/src/results/checkpoint.rs`, say there what changed, and record the bits with \
                 HAMILTONIAN_RECORD=1",
                changed.join("\n")
            ));
        }
    }
    let lines = (found.iter()).map(|(name, word)| format!("{word:016x} {name}\n"));
    Ok(format!(
        "version {version}\n{}",
        lines.collect::<Vec<_>>().concat()
    ))
}

/// Compares words with the record of this name among the tests, or records them with
/// `HAMILTONIAN_RECORD=1`. Any saved run has the version.
pub fn check(name: &str, saved: &Checkpoint, found: &BTreeMap<String, u64>) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = root.join("tests").join(name);
    let record = std::fs::read_to_string(&path).unwrap_or_default();
    let renewed = renewed(&record, version(saved), found).unwrap_or_else(|error| panic!("{error}"));
    if std::env::var_os("HAMILTONIAN_RECORD").is_some_and(|value| value == "1") {
        std::fs::write(path, renewed).expect("the record can be written");
    } else {
        assert_eq!(
            record,
            renewed,
            "HAMILTONIAN_RECORD=1 records the bits in {}",
            path.display()
        );
    }
}

#[test]
fn bits_change_with_the_version_only() {
    let words = |words: &[(&str, u64)]| -> BTreeMap<String, u64> {
        (words.iter())
            .map(|(name, word)| (name.to_string(), *word))
            .collect()
    };
    let [one, other] = [1, 2].map(|word| words(&[("a b", word), ("c", 3)]));
    let record = renewed("", 2, &one).expect("nothing is recorded");
    assert_eq!(
        record,
        "version 2\n0000000000000001 a b\n0000000000000003 c\n"
    );
    assert_eq!(renewed(&record, 2, &one), Ok(record.clone()));
    let refused = renewed(&record, 2, &other).expect_err("another word");
    assert!(
        refused.contains("\n0000000000000001 a b\nhelp"),
        "{refused}"
    );
    let raised = renewed(&record, 3, &other).expect("another version");
    assert_eq!(
        raised,
        "version 3\n0000000000000002 a b\n0000000000000003 c\n"
    );
    // A run that is added, and one that is no longer made.
    let more = words(&[("a b", 1), ("d", 5)]);
    let more = renewed(&record, 2, &more).expect("the common run is the same");
    assert_eq!(
        more,
        "version 2\n0000000000000001 a b\n0000000000000005 d\n"
    );
}
