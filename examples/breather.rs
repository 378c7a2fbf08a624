//! A ring soliton of the sine-Gordon field in two dimensions shrinks, turns and grows again.
//!
//! H = ∫ (π² + |∇φ|²)/2 + 1 − cos φ. A circular kink, 4 arctan exp(r − R), has a surface tension, so that its
//! radius obeys R̈ = −(1 − Ṙ²)/R: R = R₀ cos(t/R₀) until it is small (P. L. Christiansen and P. S. Lomdahl,
//! Physica D 2, 482, 1981). It returns several times and radiates.
//!
//! Prints the radius against the formula and how H is preserved. The picture has the field at four times, in rows:
//! `target/breather/rings.svg`. `-- N` makes N times as many sites along each axis, on all cores.

use checks::Checks;
use hamiltonian::Lattice;
use hamiltonian::plot::Figure;
use hamiltonian::prelude::*;

#[path = "support/checks.rs"]
mod checks;

hamiltonian! {
    /// The sine-Gordon field on a torus, at sites with the distance d.
    pub struct SineGordon { n: usize, m: usize, d = 0.25 }
    H(u[n][m]; p[n][m]) = sum(i in 0..n, j in 0..m) {
        p[i][j]^2/2 + 1 - cos(u[i][j])
            + ((u[(i + 1) % n][j] - u[i][j])^2 + (u[i][(j + 1) % m] - u[i][j])^2)/(2*d^2)
    }
}

/// The edge of the torus and the radius of the ring at the start.
const EDGE: f64 = 32.0;
const RADIUS: f64 = 10.0;

/// The times of the picture.
const TIMES: [f64; 4] = [0.0, 8.0, 14.0, 24.0];

/// The radius of a field's ring, where φ = π on the ray to the right.
fn radius(u: &Lattice<f64, 2>, d: f64) -> f64 {
    use std::f64::consts::PI;
    let [n, m] = u.extents();
    let value = |j: usize| u[[n / 2, j]] - PI;
    let crossing = (m / 2..m - 1).find(|j| value(*j) >= 0.0 && value(j + 1) < 0.0);
    crossing.map_or(f64::NAN, |j| {
        (j as f64 + value(j) / (value(j) - value(j + 1)) - (m / 2) as f64) * d
    })
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let fine = match std::env::args().nth(1) {
        Some(number) => number.parse::<usize>()?,
        None => 1,
    };
    let d = 0.25 / fine as f64;
    let n = (EDGE / d) as usize;
    let mut field = SineGordon::new(n, n)?;
    field.d = d;
    let u = |[i, j]: [usize; 2]| {
        let [y, x] = [i, j].map(|k| (k as f64 - (n / 2) as f64) * d);
        4.0 * (RADIUS - x.hypot(y)).exp().atan()
    };
    let start = State::new(
        Lattice::from_fn([n, n], u),
        Lattice::from_fn([n, n], |_| 0.0),
    );

    let step = d / 4.0;
    let cores = std::thread::available_parallelism()?.get();
    let mut run = Integrator::new(&field, StormerVerlet::default(), start, step)?
        .with_threads(cores)
        .observe(every(10, EnergyDrift::new()));
    let mut checks = Checks::default();
    let mut frames = Vec::new();
    for t in TIMES {
        run.advance((t / step) as u64 - run.steps())?;
        let u = &run.state().q;
        frames.push(u.clone());
        if t < 10.0 {
            let due = RADIUS * (t / RADIUS).cos();
            checks.compare(format!("radius at t = {t}"), radius(u, d), due, 0.3);
        }
    }
    checks.compare(
        "max |ΔH/H₀|",
        run.observer().inner().max_relative(),
        0.0,
        2e-3,
    );

    // One pixel for each site of the coarsest lattice, and gaps between the frames.
    let (pixels, gap) = (n / fine, 4);
    let whole = pixels + gap;
    let side = 2 * whole - gap;
    let all = Lattice::from_fn([side, side], |[i, j]| {
        // Rows count from below, frames from above.
        let frame = &frames[2 * (1 - i / whole) + j / whole];
        match [i % whole, j % whole] {
            [i, j] if i < pixels && j < pixels => frame[[i * fine, j * fine]],
            _ => f64::NAN,
        }
    });
    let [a, b, c, d] = TIMES;
    let edge = EDGE * side as f64 / pixels as f64;
    Figure {
        title: format!("A ring of the sine-Gordon field at t = {a}, {b}, {c} and {d}"),
        equal: true,
        ..Figure::field(0.0..edge, 0.0..edge, all)
    }
    .write("target/breather/rings.svg")?;
    println!("Written to target/breather/rings.svg");
    checks.finish()
}
