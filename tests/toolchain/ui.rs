//! Errors as rustc shows them: where spans lead, that a stub raises no further error, and errors
//! in the words of rustc.
//!
//! The words and places of every diagnostic are checked in process, in `hamiltonian-macros`
//! (`src/tests/refused`); here stand only those whose place goes through rustc in another way.
//! `ui/rustc` holds errors that rustc words (bounds that are not met, names it does not find). They
//! change with the compiler and run with the one they were recorded with. `TRYBUILD=overwrite`
//! records both anew.

use std::env;
use std::io::Write;
use std::process::Command;

/// The compiler whose words `ui/rustc` holds.
const RECORDED_WITH: &str = "rustc 1.95.";

/// The flags of rustc, by the separator of `CARGO_ENCODED_RUSTFLAGS`: those of trybuild. By itself trybuild gives the
/// width of messages to the programs alone, so that cargo checks their dependencies a second time.
const FLAGS: &str = "--cfg\x1ftrybuild\x1f--verbose\x1f-A\x1fdead_code\x1f--diagnostic-width=140";

#[test]
fn our_words() {
    refuses("ui::our_words", "tests/ui/fail/*.rs");
}

#[test]
fn words_of_rustc() {
    let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let version = Command::new(rustc).arg("--version").output();
    let version = version.map_or_else(
        |error| error.to_string(),
        |output| String::from_utf8_lossy(&output.stdout).into_owned(),
    );
    if version.starts_with(RECORDED_WITH) {
        refuses("ui::words_of_rustc", "tests/ui/rustc/*.rs");
    } else {
        // Not `eprintln!`, which the test harness keeps to itself.
        let note = format!(
            "skipped: tests/ui/rustc was recorded with {RECORDED_WITH}x, this is {version}\n"
        );
        let _ = std::io::stderr().write_all(note.as_bytes());
    }
}

/// Compares rustc's messages about programs with the recorded ones: the test `name` runs a second time in a process of
/// its own, whose environment has the flags.
fn refuses(name: &str, programs: &str) {
    const VARIABLE: &str = "CARGO_ENCODED_RUSTFLAGS";
    if env::var_os(VARIABLE).is_some_and(|flags| flags == FLAGS) {
        trybuild::TestCases::new().compile_fail(programs);
        return;
    }
    let mut test = Command::new(env::current_exe().expect("a test has a path"));
    test.args(["--exact", name, "--nocapture"])
        .env(VARIABLE, FLAGS);
    let output = test.output().expect("a test runs");
    let text = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success() && text.contains("1 passed"),
        "{text}"
    );
}
