//! What a wrong definition is told: a file for each diagnostic, with what rustc then shows.
//!
//! `ui/fail` holds errors in this library's words, `ui/rustc` those that rustc words (bounds that
//! are not met, names it does not find). The latter change with the compiler and run with the one
//! they were recorded with. `TRYBUILD=overwrite` records them anew.

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
