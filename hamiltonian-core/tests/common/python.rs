//! Python, as far as the machine has it: it reads the files that are written here.

use std::process::Command;

/// Returns true if Python has these packages; says on standard error which is missing.
pub fn has(packages: &[&str]) -> bool {
    for package in packages {
        let found = Command::new("python3")
            .args(["-c", &format!("import {package}")])
            .output();
        if !found.is_ok_and(|output| output.status.success()) {
            eprintln!("SKIPPED: python3 has no `{package}`");
            return false;
        }
    }
    true
}

/// Runs a program, and returns what it prints.
pub fn run(program: &str, arguments: &[&str]) -> String {
    let output = (Command::new("python3").args(["-W", "error", "-c", program]))
        .args(arguments)
        .output()
        .unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
    String::from_utf8(output.stdout).unwrap()
}
