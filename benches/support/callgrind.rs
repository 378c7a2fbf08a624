//! Instructions a step: this program runs itself under callgrind.
//!
//! `PROGRAM --workload NUMBER library|twin STEPS` makes the steps and nothing else; two such runs
//! of different length, subtracted, leave what a step costs.

use crate::valgrind;
use crate::workloads::ALL;

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

fn instructions(number: usize, which: &str, steps: u64) -> u64 {
    let program = std::env::current_exe().expect("this program's path");
    let (number, steps) = (number.to_string(), steps.to_string());
    let arguments = ["--workload", &number, which, &steps];
    valgrind::instructions(&program, &arguments, None).expect("the workload runs")
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
