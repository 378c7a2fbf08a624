//! Newton's gravity from three bodies to hundreds, by one definition.
//!
//! Three bodies run after each other on a figure eight (C. Moore 1993; A. Chenciner and R. Montgomery, Annals of
//! Mathematics 152, 881, 2000). Then a ball of stars at rest collapses; `cargo run --release --example nbody -- N`
//! sets the number of stars.
//!
//! The program prints the gap of the eight after a period; the time at which the ball is smallest, beside the time
//! of free fall of a uniform ball, ½π√(R³/2GM); and the mean of 2T/|V|, which by the virial theorem would be 1 if no
//! star were ejected. Pictures: `target/nbody/eight.svg` and `target/nbody/collapse.svg`.

use checks::Checks;
use hamiltonian::plot::{Curve, Figure};
use hamiltonian::prelude::*;
use std::f64::consts::PI;
use std::path::Path;

#[path = "support/checks.rs"]
mod checks;

hamiltonian! {
    /// Point masses under Newtonian gravity, G = 1, softened at the distance `epsilon`.
    pub struct Gravity { n: usize, m: [n], epsilon = 0.0 }
    let T = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) };
    let V = -sum(i in 0..n, j in 0..i) { m[i]*m[j]/sqrt(norm_squared(q[i] - q[j]) + epsilon^2) };
    H(q[n][3]; p[n][3]) = T + V;
    invariant total_momentum = sum(i in 0..n) { p[i] };
    invariant angular_momentum = sum(i in 0..n) { cross(q[i], p[i]) };
    monitor kinetic = T;
    monitor radius = sum(i in 0..n) { m[i]*norm(q[i]) }/sum(i in 0..n) { m[i] }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let n = match std::env::args().nth(1) {
        Some(number) => number.parse()?,
        None => 200,
    };
    let mut checks = Checks::default();
    eight(&mut checks)?;
    collapse(n, &mut checks)?;
    println!("Written to target/nbody: eight.svg, collapse.svg");
    checks.finish()
}

/// Three bodies of mass 1, one period.
fn eight(checks: &mut Checks) -> Result<(), Box<dyn std::error::Error>> {
    const PERIOD: f64 = 6.325913982926279;
    const STEPS: u64 = 100_000;
    let (x, y) = (0.97000435669734, -0.2430875315358352);
    let (v, w) = (0.4662036857205251, 0.4323657304605008);
    let start = State::new(
        vec![[x, y, 0.0], [-x, -y, 0.0], [0.0; 3]],
        vec![[v, w, 0.0], [v, w, 0.0], [-2.0 * v, -2.0 * w, 0.0]],
    );
    let three = Gravity::new(3, vec![1.0; 3])?;
    println!("{three}");

    // H is separable: the explicit symplectic scheme. It is of order 2, so the step is short.
    let step = PERIOD / STEPS as f64;
    let mut run = Integrator::new(&three, StormerVerlet::default(), start.clone(), step)?
        .observe(Monitors::new());
    let mut orbits = [(); 3].map(|()| Vec::new());
    for state in run.states(STEPS / 500).take(500) {
        let state = state?;
        for (i, orbit) in orbits.iter_mut().enumerate() {
            // A third of the period for each to reach the next one's place.
            if state.t <= PERIOD * 0.334 {
                orbit.push((state.q[(i, 0)], state.q[(i, 1)]));
            }
        }
    }
    let end = run.state();
    let distance = (&end.q - &start.q).norm();
    checks.compare(
        "eight: distance from the start after a period",
        distance,
        0.0,
        1e-7,
    );
    for monitor in run.observer().all().iter().take(6) {
        let what = format!("eight: max |Δ {}|", monitor.name);
        checks.compare(what, monitor.drift.max_absolute(), 0.0, 1e-12);
    }
    Figure {
        title: "The figure eight: the paths of three bodies in a third of a period".into(),
        x: "x".into(),
        y: "y".into(),
        equal: true,
        curves: orbits
            .into_iter()
            .zip(1..)
            .map(|(points, body)| Curve {
                name: format!("body {body}"),
                points,
            })
            .collect(),
        ..Default::default()
    }
    .write(Path::new("target/nbody/eight.svg"))?;
    Ok(())
}

/// Numbers in [0, 1), the same in every run: G. Marsaglia, Journal of Statistical Software 8 (14),
/// 2003.
fn numbers() -> impl Iterator<Item = f64> {
    let mut x = 88_172_645_463_325_252_u64;
    std::iter::from_fn(move || {
        x ^= x << 13;
        x ^= x >> 7;
        x ^= x << 17;
        Some((x >> 11) as f64 / (1_u64 << 53) as f64)
    })
}

/// A ball of mass 1 and radius 1, n stars at rest.
fn collapse(n: usize, checks: &mut Checks) -> Result<(), Box<dyn std::error::Error>> {
    let mut numbers = numbers();
    let mut star = || loop {
        let x: [f64; 3] = std::array::from_fn(|_| 2.0 * numbers.next().unwrap_or(0.0) - 1.0);
        if x.iter().map(|c| c * c).sum::<f64>() < 1.0 {
            break x;
        }
    };
    let start = State::new(
        (0..n).map(|_| star()).collect::<Vec<_>>(),
        vec![[0.0; 3]; n],
    );
    let mut ball = Gravity::new(n, vec![1.0 / n as f64; n])?;
    ball.epsilon = 0.05;

    let mut run = Integrator::new(&ball, StormerVerlet::default(), start, 0.0025)?
        .observe(every(8, (EnergyDrift::new(), Recorder::new())));
    run.advance_to(8.0)?;

    let (drift, record) = run.observer().inner();
    let column = |name| record.column(name).ok_or(format!("no column {name}"));
    let radius: Vec<_> = column("t")?.zip(column("radius")?).collect();
    let (fall, _) =
        radius
            .iter()
            .filter(|(t, _)| *t < 2.0)
            .fold((0.0, f64::INFINITY), |best, next| {
                if next.1 < best.1 { *next } else { best }
            });
    // −V = T − H.
    let energy = run.energy();
    let virial = column("kinetic")?.map(|kinetic| 2.0 * kinetic / (kinetic - energy));
    let virial: Vec<_> = column("t")?.zip(virial).collect();
    let late: Vec<f64> = virial
        .iter()
        .filter(|(t, _)| *t > 3.0)
        .map(|(_, v)| *v)
        .collect();
    let mean = late.iter().sum::<f64>() / late.len() as f64;

    checks.compare(
        format!("{n} stars: the ball is smallest at t ="),
        fall,
        PI / 8.0_f64.sqrt(),
        0.1,
    );
    checks.compare(
        format!("{n} stars: mean of 2T/|V| after t = 3"),
        mean,
        1.0,
        0.15,
    );
    checks.compare(
        format!("{n} stars: max |ΔH/H₀|"),
        drift.max_relative(),
        0.0,
        1e-2,
    );
    Figure {
        title: format!("{n} stars fall together"),
        x: "time".into(),
        y: "".into(),
        curves: vec![
            Curve {
                name: "mean distance from the centre".into(),
                points: radius,
            },
            Curve {
                name: "2T/|V|".into(),
                points: virial,
            },
        ],
        ..Default::default()
    }
    .write(Path::new("target/nbody/collapse.svg"))?;
    Ok(())
}
