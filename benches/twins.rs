//! For every workload, the library against its hand-written twin: instructions a step where
//! callgrind is there, and the ratio of times in one process.
//!
//! `cargo bench --bench twins` prints both. Times on a shared machine flicker; the ratio is that of
//! the fastest of several alternating rounds, and nothing depends on it. With `-- --check` nothing
//! is timed, and it fails where a step takes more than 1.02 times its twin's instructions, or where
//! the two do not reach the same end.

use std::hint::black_box;
use std::time::{Duration, Instant};

#[path = "support/callgrind.rs"]
mod callgrind;
#[path = "support/valgrind.rs"]
mod valgrind;
#[path = "support/workloads.rs"]
mod workloads;

fn main() {
    if callgrind::run_if_asked() {
        return;
    }
    let check = std::env::args().any(|argument| argument == "--check");
    let counted = valgrind::is_there();
    if !counted {
        println!("SKIPPED: valgrind is not on this machine, instructions are not counted");
    }
    if check {
        let failed = workloads::ALL
            .iter()
            .enumerate()
            .filter(|(number, workload)| !passes(*number, workload, counted))
            .count();
        println!("{} passed, {failed} failed", workloads::ALL.len() - failed);
        std::process::exit(i32::from(failed > 0));
    }
    println!(
        "{:<32} {:>12} {:>12} {:>8} {:>10} {:>10} {:>8}",
        "workload", "instr/step", "twin", "ratio", "ns/step", "twin", "ratio"
    );
    for (number, workload) in workloads::ALL.iter().enumerate() {
        let (library, twin) = if counted {
            callgrind::per_step(number)
        } else {
            (f64::NAN, f64::NAN)
        };
        let steps = 2_000_000;
        let time = |run: fn(u64) -> Vec<f64>| {
            let start = Instant::now();
            black_box(run(black_box(steps)));
            start.elapsed()
        };
        let (mut fast, mut fast_twin) = (Duration::MAX, Duration::MAX);
        for _ in 0..7 {
            fast = fast.min(time(workload.library));
            fast_twin = fast_twin.min(time(workload.twin));
        }
        let nanoseconds = |t: Duration| t.as_secs_f64() * 1e9 / steps as f64;
        println!(
            "{:<32} {library:>12.2} {twin:>12.2} {:>8.3} {:>10.2} {:>10.2} {:>8.3}",
            workload.name,
            library / twin,
            nanoseconds(fast),
            nanoseconds(fast_twin),
            fast.as_secs_f64() / fast_twin.as_secs_f64()
        );
    }
}

/// Returns true if a workload ends where its twin does, at no more than 1.02 times the instructions.
fn passes(number: usize, workload: &workloads::Workload, counted: bool) -> bool {
    let (library, twin) = ((workload.library)(1000), (workload.twin)(1000));
    // Different roundings of the same 1000 steps of size 1e-3.
    let together = library
        .iter()
        .zip(&twin)
        .all(|(a, b)| (a - b).abs() < 1e-12);
    if !together {
        println!(
            "FAILED {}: ends at {library:?}, its twin at {twin:?}",
            workload.name
        );
    }
    if !counted {
        return together;
    }
    let (library, twin) = callgrind::per_step(number);
    let cheap = library <= 1.02 * twin;
    let verdict = if cheap { "ok" } else { "FAILED" };
    println!(
        "{verdict} {}: {library:.2} instructions a step, twin {twin:.2}, ratio {:.4}",
        workload.name,
        library / twin
    );
    together && cheap
}
