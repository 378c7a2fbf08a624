//! Two threads against one, by wall time and by the CPU time of both.
//!
//! Wall times need two free cores; the CPU time shows what the work costs more.

use std::time::Instant;

/// CPU time of all threads of this process since its start, in seconds, where Linux tells.
fn of_all_threads() -> Option<f64> {
    /// Ticks a second that Linux shows to programs.
    const TICKS: f64 = 100.0;
    let line = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The name of the program is in brackets, and may have spaces; twelve fields on is the user's time.
    let (_, fields) = line.rsplit_once(") ")?;
    let ticks = fields.split(' ').skip(11).take(2).map(str::parse::<f64>);
    Some(ticks.sum::<Result<f64, _>>().ok()? / TICKS)
}

/// Prints how many times as fast the second work is as the first, and how much CPU time it takes, in rounds that
/// alternate.
pub fn compare(name: &str, rounds: usize, mut work: impl FnMut(usize)) {
    let (mut least, mut spent) = ([f64::INFINITY; 2], [0.0; 2]);
    for _ in 0..rounds {
        for k in 0..2 {
            let (begin, before) = (Instant::now(), of_all_threads());
            work(k);
            least[k] = begin.elapsed().as_secs_f64().min(least[k]);
            let now = of_all_threads().zip(before);
            spent[k] += now.map_or(f64::NAN, |(now, before)| now - before);
        }
    }
    println!(
        "{name}: two threads: {:.2} × as fast as one by wall time, {:.3} × the CPU time",
        least[0] / least[1],
        spent[1] / spent[0]
    );
}
