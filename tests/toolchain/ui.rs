//! Errors as rustc shows them: where spans lead, that a stub raises no further error, and errors
//! in the words of rustc.
//!
//! The words and places of every diagnostic are checked in process, in `hamiltonian-macros`
//! (`src/tests/refused`); here stand only those whose place goes through rustc in another way.
//! `ui/rustc` holds errors that rustc words (bounds that are not met, names it does not find). They
//! change with the compiler and run with the one they were recorded with. `TRYBUILD=overwrite`
//! records both anew.

use std::io::Write;
use std::process::Command;

/// The compiler whose words `ui/rustc` holds.
const RECORDED_WITH: &str = "rustc 1.95.";

#[test]
fn our_words() {
    trybuild::TestCases::new().compile_fail("tests/ui/fail/*.rs");
}

#[test]
fn words_of_rustc() {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let version = Command::new(rustc).arg("--version").output();
    let version = version.map_or_else(
        |error| error.to_string(),
        |output| String::from_utf8_lossy(&output.stdout).into_owned(),
    );
    if version.starts_with(RECORDED_WITH) {
        trybuild::TestCases::new().compile_fail("tests/ui/rustc/*.rs");
    } else {
        // Not `eprintln!`, which the test harness keeps to itself.
        let note = format!(
            "skipped: tests/ui/rustc was recorded with {RECORDED_WITH}x, this is {version}\n"
        );
        let _ = std::io::stderr().write_all(note.as_bytes());
    }
}
