//! A step costs what it costs by hand: instructions within 1.00 to 1.02 of the hand-written twin.
//!
//! Counted by callgrind, so that it can be asserted; where that is not on the machine this says so
//! and checks only that both reach the same end.

#[path = "../benches/support/callgrind.rs"]
mod callgrind;
#[path = "../benches/support/workloads.rs"]
mod workloads;

fn main() {
    if callgrind::run_if_asked() {
        return;
    }
    let mut failures = Vec::new();
    for workload in workloads::ALL {
        let (library, twin) = ((workload.library)(1000), (workload.twin)(1000));
        for (a, b) in library.iter().zip(&twin) {
            // Different roundings of the same 1000 steps of size 1e-3.
            if (a - b).abs() > 1e-12 {
                failures.push(format!("{}: {library:?} is not {twin:?}", workload.name));
            }
        }
    }
    if callgrind::is_there() {
        for (number, workload) in workloads::ALL.iter().enumerate() {
            let (library, twin) = callgrind::per_step(number);
            println!("{:<32} {library:8.2} instructions a step, twin {twin:8.2}, ratio {:.4}", workload.name, library / twin);
            if library / twin > 1.02 {
                failures.push(format!("{}: ratio {:.4} is above 1.02", workload.name, library / twin));
            }
        }
    } else {
        println!("SKIPPED: valgrind is not on this machine, instructions are not counted");
    }
    let passed = workloads::ALL.len() - failures.len().min(workloads::ALL.len());
    for failure in &failures {
        println!("FAILED {failure}");
    }
    println!("{passed} passed, {} failed", failures.len());
    assert!(failures.is_empty());
}
