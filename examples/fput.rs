//! The chain of Fermi, Pasta, Ulam and Tsingou: the energy of the first mode returns.
//!
//! 32 springs with a quadratic correction and fixed ends start with all energy in the lowest normal mode. The
//! energy spreads to the next modes, as the authors expected, and returns, which they did not expect. The report of
//! 1955 states that after 157 periods of the mode all but 3 % of the energy is back (E. Fermi, J. Pasta, S. Ulam,
//! M. Tsingou, Los Alamos report LA-1940, 1955, figure 1; N. J. Zabusky and M. D. Kruskal, Physical Review Letters
//! 15, 240, 1965).
//!
//! The program prints the time of the return with the step of 1955, δt² = 1/8, and with finer steps. The coarse
//! step accounts for ten of the 157 periods. Picture: `target/fput/modes.svg`, figure 1 of the report.

use checks::Checks;
use hamiltonian::plot::{Curve, Figure};
use hamiltonian::prelude::*;
use std::f64::consts::PI;
use std::path::Path;

#[path = "support/checks.rs"]
mod checks;

hamiltonian! {
    /// N particles between fixed walls; the springs' force is r + α r².
    pub struct Fput<const N: usize> { alpha = 0.25 }
    let V(r) = r^2/2 + alpha*r^3/3;
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 } + V(q[0]) + V(-q[N - 1])
        + sum(i in 1..N) { V(q[i] - q[i - 1]) }
}

/// 32 springs hold 31 particles.
const SPRINGS: usize = 32;
const N: usize = SPRINGS - 1;
/// Modes that are drawn.
const SHOWN: usize = 5;

/// The frequency of mode k = 1, 2, … without the quadratic correction.
fn frequency(k: usize) -> f64 {
    2.0 * (PI * k as f64 / (2 * SPRINGS) as f64).sin()
}

/// The displacement of particle i = 0, 1, … in mode k, normalised.
fn shape(k: usize, i: usize) -> f64 {
    (2.0 / SPRINGS as f64).sqrt() * (PI * (k * (i + 1)) as f64 / SPRINGS as f64).sin()
}

/// The energy of mode k.
fn energy(k: usize, q: &[f64], p: &[f64]) -> f64 {
    let component = |x: &[f64]| -> f64 { (0..N).map(|i| shape(k, i) * x[i]).sum() };
    (component(p).powi(2) + (frequency(k) * component(q)).powi(2)) / 2.0
}

/// The energies of the modes over a run.
struct Story {
    /// Energies of the lowest modes against time in periods of the first.
    modes: Vec<Curve>,
    /// The time at which most of the energy is back in mode 1, in periods, and its share.
    back: (f64, f64),
    /// The least share of mode 1 before that time.
    least: f64,
    /// max |ΔH/H₀|
    drift: f64,
}

/// Runs the chain for 175 periods.
fn tell(chain: &Fput<N>, step: f64) -> Result<Story, Error> {
    let sine: [f64; N] = std::array::from_fn(|i| (PI * (i + 1) as f64 / SPRINGS as f64).sin());
    let all = energy(1, &sine, &[0.0; N]);
    let period = 2.0 * PI / frequency(1);
    let mut modes: Vec<Curve> = (1..=SHOWN)
        .map(|k| Curve {
            name: format!("mode {k}"),
            points: Vec::new(),
        })
        .collect();
    // H is separable and the run is long: the explicit symplectic scheme, which the authors used too.
    let start = State::new(sine, [0.0; N]);
    let mut run =
        Integrator::new(chain, StormerVerlet::default(), start, step)?.observe(EnergyDrift::new());
    let every = (2.0 / step) as u64;
    let looks = (175.0 * period / step) as usize / every as usize;
    for state in run.states(every).take(looks) {
        let state = state?;
        for (k, curve) in (1..).zip(&mut modes) {
            let energy = energy(k, state.q.as_slice(), state.p.as_slice());
            curve.points.push((state.t / period, energy));
        }
    }
    let mut back = (0.0, 0.0);
    let mut least = f64::INFINITY;
    for (t, energy) in &modes[0].points {
        let share = energy / all;
        least = least.min(share);
        if *t > 120.0 && share > back.1 {
            back = (*t, share);
        }
    }
    Ok(Story {
        modes,
        back,
        least,
        drift: run.observer().max_relative(),
    })
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let chain = Fput::default();
    let of_1955 = tell(&chain, 0.125_f64.sqrt())?;
    let finer = tell(&chain, 0.1)?;
    let finest = tell(&chain, 0.05)?;

    println!("{chain}");
    println!(
        "\n{:>8} {:>14} {:>14} {:>14} {:>14}",
        "step", "back after", "share back", "least share", "max |ΔH/H₀|"
    );
    for (step, story) in [("√(1/8)", &of_1955), ("0.1", &finer), ("0.05", &finest)] {
        println!(
            "{step:>8} {:>14.1} {:>14.4} {:>14.4} {:>14.1e}",
            story.back.0, story.back.1, story.least, story.drift
        );
    }
    Figure {
        title: "The chain of Fermi, Pasta, Ulam and Tsingou: α = 1/4, 32 springs, δt² = 1/8".into(),
        x: "time in periods of mode 1".into(),
        y: "energy of a mode".into(),
        curves: of_1955.modes,
        ..Default::default()
    }
    .write(Path::new("target/fput/modes.svg"))?;
    println!("Written to target/fput/modes.svg");

    let mut checks = Checks::default();
    checks.compare(
        "periods until it is back, step of 1955",
        of_1955.back.0,
        157.0,
        1.0,
    );
    checks.compare("share that is back then", of_1955.back.1, 0.97, 0.01);
    checks.compare(
        "periods, step 0.1, against step 0.05",
        finer.back.0,
        finest.back.0,
        1.0,
    );
    checks.compare("max |ΔH/H₀|, step 0.05", finest.drift, 0.0, 1e-4);
    checks.finish()
}
