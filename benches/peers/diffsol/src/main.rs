//! diffsol on the problems of the comparison: Tsitouras's pair of order 5(4), its explicit method.
//!
//! Prints one JSON object a line, as `peer.py` does. With a name as argument only that problem is solved.

use diffsol::{MatrixCommon, NalgebraMat, OdeBuilder, OdeSolverMethod};
use serde_json::{Value, json};
use std::time::Instant;

const RUNS: usize = 5;
const SECONDS: f64 = 0.05;
const TOLERANCES: [f64; 4] = [1e-6, 1e-9, 1e-11, 1e-13];
const VERSION: &str = "0.18.0";

/// CPU seconds of this thread; elsewhere than on Linux wall-clock seconds.
fn clock(began: Instant) -> f64 {
    let of_thread = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = of_thread.and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| began.elapsed().as_secs_f64(), |ns| 1e-9 * ns)
}

fn time(mut run: impl FnMut()) -> f64 {
    let began = Instant::now();
    let mut times: Vec<f64> = (0..RUNS)
        .map(|_| {
            let (begin, mut count) = (clock(began), 0.0);
            loop {
                run();
                count += 1.0;
                let seconds = clock(began) - begin;
                if seconds >= SECONDS {
                    return seconds / count;
                }
            }
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[RUNS / 2]
}

fn numbers(value: &Value) -> Vec<f64> {
    let values = value.as_array().map(Vec::as_slice).unwrap_or_default();
    values.iter().filter_map(Value::as_f64).collect()
}

/// The end point; an error is a result too.
fn end(
    field: &(impl Fn(&[f64], &mut [f64]) + Clone + 'static),
    start: &[f64],
    end: f64,
    tolerance: f64,
) -> Result<Vec<f64>, Box<dyn std::error::Error>> {
    let (field, begin) = (field.clone(), start.to_vec());
    let problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(tolerance)
        .atol([tolerance])
        .rhs(move |x, _, _, y| field(x, y))
        .init(move |_, _, y| y.copy_from_slice(&begin), start.len())
        .build()?;
    let mut solver = problem.tsit45()?;
    let (states, ..) = solver.solve_dense(&[end])?;
    let states = states.inner();
    Ok(states.column(states.ncols() - 1).iter().copied().collect())
}

fn rows(problem: &Value, field: impl Fn(&[f64], &mut [f64]) + Clone + 'static) {
    let (start, reference) = (numbers(&problem["start"]), numbers(&problem["reference"]));
    let mut low = numbers(&problem["reference_low"]);
    low.resize(reference.len(), 0.0);
    let to = problem["end"].as_f64().unwrap_or(f64::NAN);
    for tolerance in TOLERANCES {
        let mut row = json!({
            "problem": problem["problem"], "peer": "diffsol", "version": VERSION,
            "method": "Tsitouras 5(4)", "setting": format!("tol {tolerance:e}"),
        });
        match end(&field, &start, to, tolerance) {
            Ok(reached) => {
                let exact = reference.iter().zip(&low);
                let apart = reached
                    .iter()
                    .zip(exact)
                    .map(|(x, (high, low))| (x - high - low).abs());
                row["error"] = json!(apart.fold(0.0, f64::max));
                row["seconds"] = json!(time(|| {
                    let _ = end(&field, &start, to, tolerance);
                }));
            }
            Err(reason) => row["failed"] = json!(reason.to_string()),
        }
        println!("{row}");
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let only = std::env::args().nth(1);
    let file = std::env::var("PROBLEMS")?;
    for line in std::fs::read_to_string(file)?.lines() {
        let problem: Value = serde_json::from_str(line)?;
        let name = problem["problem"].as_str().unwrap_or_default().to_string();
        if only.as_ref().is_some_and(|only| *only != name) {
            continue;
        }
        let parameter = |key: &str| {
            numbers(&problem["parameters"][key])
                .first()
                .copied()
                .unwrap_or(f64::NAN)
        };
        match name.as_str() {
            "kepler" | "encounter" => rows(&problem, |z, d| {
                let square = z[0] * z[0] + z[1] * z[1];
                let cube = square * square.sqrt();
                d.copy_from_slice(&[z[2], z[3], -z[0] / cube, -z[1] / cube]);
            }),
            "henon_heiles" => rows(&problem, |z, d| {
                let (x, y) = (z[0], z[1]);
                d.copy_from_slice(&[z[2], z[3], -x - 2.0 * x * y, -y - x * x + y * y]);
            }),
            "pendulum" => rows(&problem, |z, d| d.copy_from_slice(&[z[1], -z[0].sin()])),
            "coupled" => rows(&problem, |z, d| {
                d.copy_from_slice(&[(z[0] * z[0] + 1.0) * z[1], -z[0] * (z[1] * z[1] + 1.0)]);
            }),
            "black_hole" => {
                let (energy, momentum) = (parameter("E"), parameter("L"));
                rows(&problem, move |z, d| {
                    let (r, u, v) = (z[0], z[2], z[3]);
                    let (s, c) = z[1].sin_cos();
                    let of_r = (u / r).powi(2) - v * v / r.powi(3) + (energy / (r - 2.0)).powi(2)
                        - (momentum / s).powi(2) / r.powi(3);
                    let of_theta = (momentum / r).powi(2) * c / s.powi(3);
                    d.copy_from_slice(&[(1.0 - 2.0 / r) * u, v / (r * r), -of_r, of_theta]);
                });
            }
            "fput" => {
                let alpha = parameter("alpha");
                rows(&problem, move |z, d| {
                    let n = z.len() / 2;
                    let spring = |a: f64, b: f64| (b - a) + alpha * (b - a) * (b - a);
                    for i in 0..n {
                        let before = if i > 0 { z[i - 1] } else { 0.0 };
                        let after = if i + 1 < n { z[i + 1] } else { 0.0 };
                        d[i] = z[n + i];
                        d[n + i] = spring(z[i], after) - spring(before, z[i]);
                    }
                });
            }
            "toda" => rows(&problem, |z, d| {
                let n = z.len() / 2;
                for i in 0..n {
                    d[i] = z[n + i];
                    d[n + i] = (z[(i + n - 1) % n] - z[i]).exp() - (z[i] - z[(i + 1) % n]).exp();
                }
            }),
            _ => {}
        }
    }
    Ok(())
}
