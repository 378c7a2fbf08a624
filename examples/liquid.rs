//! A liquid of Lennard-Jones atoms in a periodic box, each of which sees the nearest image of every other
//! (L. Verlet, 1967, doi:10.1103/PhysRev.159.98).
//!
//! The difference of two coordinates is `remainder(a - b, side)`, between −side/2 and side/2. The potential is cut off at
//! `reach` and shifted, so that neither it nor the force jumps there. The total momentum is conserved, since H depends on differences alone.
//!
//! Units are those of the potential: its depth, the distance at which it is 0, the mass of an atom. The program melts a
//! crystal and compares the first peak of the pair distribution with the minimum of the potential, at 2^(1/6).

use checks::Checks;
use hamiltonian::prelude::*;

#[path = "support/checks.rs"]
mod checks;

hamiltonian! {
    /// Atoms in a box.
    pub struct Liquid {
        n: usize,
        /// The side of the box.
        side = 6.0,
        /// The distance at which the potential is cut off.
        reach = 2.5,
    }
    let V(s) = 4*(1/s^6 - 1/s^3);
    // The slope of V by s at the cut-off.
    let slope = 4*(-6/reach^14 + 3/reach^8);
    let cut(s) = if s < reach^2 { V(s) - V(reach^2) - slope*(s - reach^2) } else { 0 };
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { sum(k in 0..3) { p[i][k]^2 }/2 }
        + sum(i in 0..n, j in 0..i) { cut(sum(k in 0..3) { remainder(q[i][k] - q[j][k], side)^2 }) };
    monitor momentum = sum(i in 0..n) { p[i][0] }
}

/// Cells of the crystal along an edge, of four atoms each.
const CELLS: usize = 4;
const DENSITY: f64 = 0.8;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let n = 4 * CELLS.pow(3);
    let side = (n as f64 / DENSITY).cbrt();
    let mut liquid = Liquid::new(n)?;
    liquid.side = side;
    let cell = side / CELLS as f64;
    let mut places = Vec::new();
    for x in 0..CELLS {
        for y in 0..CELLS {
            for z in 0..CELLS {
                for [a, b, c] in [
                    [0.0, 0.0, 0.0],
                    [0.5, 0.5, 0.0],
                    [0.5, 0.0, 0.5],
                    [0.0, 0.5, 0.5],
                ] {
                    places.push([
                        (x as f64 + a) * cell,
                        (y as f64 + b) * cell,
                        (z as f64 + c) * cell,
                    ]);
                }
            }
        }
    }
    // Any directions do, since collisions make them random; their sum is 0.
    let mut speeds: Vec<[f64; 3]> = (0..n)
        .map(|i| [0.7, 1.1, 1.3].map(|k: f64| 2.1 * (k * (i * i) as f64 + i as f64).sin()))
        .collect();
    let mean: [f64; 3] =
        std::array::from_fn(|k| speeds.iter().map(|v| v[k]).sum::<f64>() / n as f64);
    for speed in &mut speeds {
        for k in 0..3 {
            speed[k] -= mean[k];
        }
    }
    let start = State::new(places, speeds);
    let mut run = Integrator::new(&liquid, StormerVerlet::default(), start, 0.004)?
        .observe((EnergyDrift::new(), Monitors::new()));
    run.advance(1_000)?;

    // Pairs by distance, in shells of a width of 0.02.
    const SHELL: f64 = 0.02;
    let mut pairs = vec![0.0; (side / 2.0 / SHELL) as usize];
    let mut squares = 0.0;
    for state in run.states(20).take(50) {
        let state = state?;
        squares += state.p.as_slice().iter().map(|p| p * p).sum::<f64>() / 50.0;
        for i in 0..n {
            for j in 0..i {
                let image = |k| Real::remainder(state.q[(i, k)] - state.q[(j, k)], side);
                let distance = (0..3).map(|k| image(k) * image(k)).sum::<f64>().sqrt();
                if let Some(shell) = pairs.get_mut((distance / SHELL) as usize) {
                    *shell += 1.0;
                }
            }
        }
    }
    let middle = |shell: usize| (shell as f64 + 0.5) * SHELL;
    let density = |shell: usize| pairs[shell] / (middle(shell) * middle(shell));
    let peak = (0..pairs.len())
        .max_by(|a, b| density(*a).total_cmp(&density(*b)))
        .unwrap_or(0);
    println!(
        "{n} atoms in a box of side {side:.3}, temperature {:.3}",
        squares / (3 * n) as f64
    );

    let mut checks = Checks::default();
    let (drift, monitors) = run.observer();
    checks.compare("change of H by H", drift.max_relative(), 0.0, 1e-3);
    let momentum = monitors
        .get("momentum")
        .map_or(f64::NAN, |drift| drift.max_absolute());
    checks.compare("change of the momentum", momentum, 0.0, 1e-10);
    checks.compare(
        "first peak / 2^(1/6)",
        middle(peak) / 2.0_f64.powf(1.0 / 6.0),
        0.97,
        0.04,
    );
    checks.finish()
}
