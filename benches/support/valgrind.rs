//! Instructions of a program, counted by callgrind: the same on every run of the same binary on
//! the same machine.

use std::ffi::OsStr;
use std::path::Path;
use std::process::Command;

/// Returns true if valgrind is on this machine.
pub fn is_there() -> bool {
    Command::new("valgrind")
        .arg("--version")
        .output()
        .is_ok_and(|output| output.status.success())
}

/// The instructions of a run: of all of it, or of the functions whose name matches `within` and
/// what they call. `None` where the program fails.
pub fn instructions<A: AsRef<OsStr>>(
    program: &Path,
    arguments: &[A],
    within: Option<&str>,
) -> Option<u64> {
    let mut command = Command::new("valgrind");
    command.args(["--tool=callgrind", "--callgrind-out-file=/dev/null"]);
    command.args(within.map(|name| format!("--toggle-collect={name}")));
    let output = command
        .arg(program)
        .args(arguments)
        .output()
        .expect("valgrind runs");
    let text = String::from_utf8_lossy(&output.stderr);
    let counted = || {
        let count = text
            .lines()
            .find_map(|line| line.split_once("Collected :"))?
            .1;
        count.trim().parse().ok()
    };
    let count = || counted().unwrap_or_else(|| panic!("no count in:\n{text}"));
    output.status.success().then(count)
}
