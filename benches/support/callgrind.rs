//! Instructions a step, counted by callgrind: this program runs itself under it.
//!
//! `PROGRAM --workload NUMBER library|twin STEPS` makes the steps and nothing else; two such runs
//! of different length, subtracted, leave what a step costs. Counts are the same on every run of
//! the same binary on the same machine.

use crate::workloads::ALL;
use std::process::Command;

/// Makes the steps asked for on the command line, if any were; whether there were.
pub fn run_if_asked() -> bool {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, flag, number, which, steps] = arguments.as_slice() else {
        return false;
    };
    if flag != "--workload" {
        return false;
    }
    let workload = &ALL[number.parse::<usize>().expect("a workload's number")];
    let steps = steps.parse().expect("a number of steps");
    let run = if which == "twin" {
        workload.twin
    } else {
        workload.library
    };
    println!("{:?}", run(steps));
    true
}

/// Whether callgrind is on this machine.
pub fn is_there() -> bool {
    Command::new("valgrind")
        .arg("--version")
        .output()
        .is_ok_and(|output| output.status.success())
}

fn instructions(number: usize, which: &str, steps: u64) -> u64 {
    let program = std::env::current_exe().expect("this program's path");
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args(["--workload", &number.to_string(), which, &steps.to_string()])
        .output()
        .expect("valgrind runs");
    let text = String::from_utf8_lossy(&output.stderr);
    let line = text
        .lines()
        .find_map(|line| line.split_once("Collected :"))
        .unwrap_or_else(|| panic!("no count in:\n{text}"));
    line.1.trim().parse().expect("a count")
}

/// Instructions a step of one workload: by the library, and by its twin.
pub fn per_step(number: usize) -> (f64, f64) {
    // Whole blocks of the integrator, so that the check at their ends is counted as it falls.
    let (few, many) = (1 << 12, 1 << 16);
    let cost = |which| {
        (instructions(number, which, many) - instructions(number, which, few)) as f64
            / (many - few) as f64
    };
    (cost("library"), cost("twin"))
}
