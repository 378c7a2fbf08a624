//! Parts of both programs: CPU times, references, rows.

use cpu_time::ThreadTime;
use hamiltonian::Vector;
use hamiltonian::prelude::*;
use std::fmt::Write;

/// Runs of which the median is taken.
const RUNS: usize = 9;
/// A time that clocks resolve well; shorter runs are repeated within a measurement.
const SECONDS: f64 = 0.02;
/// Seconds after which three measurements are enough.
const PATIENCE: f64 = 0.3;

/// The median CPU time of a run: of nine measurements, or of at least three where they take longer together
/// than [`PATIENCE`].
pub fn time(mut run: impl FnMut()) -> f64 {
    let mut times = Vec::new();
    while times.len() < RUNS && (times.len() < 3 || times.iter().sum::<f64>() < PATIENCE) {
        let began = ThreadTime::now();
        let mut count = 0.0;
        let seconds = loop {
            run();
            count += 1.0;
            let seconds = began.elapsed().as_secs_f64();
            if seconds >= SECONDS {
                break seconds / count;
            }
        };
        times.push(seconds);
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

pub fn list(numbers: impl IntoIterator<Item = f64>) -> String {
    let mut text = String::from("[");
    for (i, number) in numbers.into_iter().enumerate() {
        let comma = if i > 0 { "," } else { "" };
        let _ = write!(text, "{comma}{number:e}");
    }
    text + "]"
}

/// The components of q, then those of p.
pub fn numbers<V: Vector>(state: &State<V>) -> Vec<V::Scalar> {
    let (q, p) = (state.q.components(), state.p.components());
    q.chain(p).collect()
}

/// The largest difference from the reference.
pub fn apart(end: &[f64], exact: &[DoubleDouble]) -> f64 {
    let difference = |(a, b): (&f64, &DoubleDouble)| (DoubleDouble::from(*a) - *b).hi().abs();
    end.iter().zip(exact).map(difference).fold(0.0, f64::max)
}

/// The largest difference of two references.
pub fn difference(coarse: &[DoubleDouble], fine: &[DoubleDouble]) -> f64 {
    let pairs = coarse.iter().zip(fine);
    pairs.map(|(a, b)| (*a - *b).hi().abs()).fold(0.0, f64::max)
}

/// A problem, as the peers read it.
pub struct Problem<'a> {
    pub name: &'a str,
    pub parameters: &'a [(&'a str, String)],
    pub rows: usize,
    pub end: f64,
    pub start: &'a [f64],
    pub reference: &'a [DoubleDouble],
    pub uncertainty: f64,
}

/// Prints a problem.
pub fn describe(problem: &Problem) {
    let Problem {
        name,
        rows,
        end,
        uncertainty,
        ..
    } = problem;
    let parameters: Vec<_> = (problem.parameters.iter())
        .map(|(key, value)| format!("\"{key}\":{value}"))
        .collect();
    println!(
        "{{\"problem\":\"{name}\",\"parameters\":{{{}}},\"rows\":{rows},\"end\":{end:e},\"start\":{},\
         \"reference\":{},\"reference_low\":{},\"uncertainty\":{uncertainty:e}}}",
        parameters.join(","),
        list(problem.start.iter().copied()),
        list(problem.reference.iter().map(|x| x.hi())),
        list(problem.reference.iter().map(|x| x.lo())),
    );
}

/// Prints a result.
pub fn row(
    problem: &str,
    method: &str,
    fused: bool,
    setting: &str,
    error: f64,
    energy: Option<f64>,
    seconds: f64,
) {
    let energy = energy.map_or_else(String::new, |energy| format!("\"energy\":{energy:e},"));
    println!(
        "{{\"problem\":\"{problem}\",\"peer\":\"hamiltonian\",\"method\":\"{method}\",\
         \"fused\":{fused},\"setting\":\"{setting}\",\"error\":{error:e},{energy}\"seconds\":{seconds:e}}}"
    );
}
