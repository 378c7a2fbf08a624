//! Prints, for every workload, the library against its hand-written twin: instructions a step
//! where callgrind is there, and the ratio of times in one process.
//!
//! Run by `cargo bench --bench twins`. Times on a shared machine flicker; the ratio is that of the
//! fastest of several alternating rounds. Nothing here passes or fails.

use std::hint::black_box;
use std::time::{Duration, Instant};

#[path = "support/callgrind.rs"]
mod callgrind;
#[path = "support/workloads.rs"]
mod workloads;

fn main() {
    if callgrind::run_if_asked() {
        return;
    }
    let counted = callgrind::is_there();
    if !counted {
        println!("valgrind is not on this machine: instructions are not counted");
    }
    println!("{:<32} {:>12} {:>12} {:>8} {:>10} {:>10} {:>8}", "workload", "instr/step", "twin", "ratio", "ns/step", "twin", "ratio");
    for (number, workload) in workloads::ALL.iter().enumerate() {
        let (library, twin) = if counted { callgrind::per_step(number) } else { (f64::NAN, f64::NAN) };
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
