//! The restricted three-body problem: Arenstorf's orbit round the Earth and the Moon.
//!
//! A spacecraft in the rotating frame of Earth and Moon starts at 6·10⁻³ of their distance from the Moon, makes
//! three wide loops and returns to its start (R. F. Arenstorf, American Journal of Mathematics 85, 27, 1963; E.
//! Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, section II.0). An error near the
//! Moon grows by a factor of up to two million along the orbit.
//!
//! The rotation of the frame couples q and p, so H is not T(p) + V(q). Free motion in a rotating frame has an exact
//! flow, and H is the sum of free motion and a potential.
//!
//! The program prints the distance of the end from the start for shorter and shorter steps; then the same in a time
//! that runs slowly near the Earth and the Moon, dt = (r₁r₂)^(3/2) ds (K. F. Sundman 1912), where order 4 suffices.
//! Pictures: `target/three_body/orbit.svg` has the orbit, `energy.svg` the drift of H on an orbit about the point
//! L₄.

use checks::Checks;
use energy::{Contest, print_pieces};
use hamiltonian::plot::{Curve, Figure};
use hamiltonian::prelude::*;
use std::path::Path;

#[path = "support/checks.rs"]
mod checks;
#[path = "support/energy.rs"]
mod energy;

hamiltonian! {
    /// The circular restricted three-body problem in the plane. The frame turns; distances are in
    /// those of Earth and Moon, and a month is 2π.
    pub struct ThreeBody {
        /// The share of the Moon in the mass.
        mu = 0.012277471,
    }
    let r_earth = hypot(x + mu, y);
    let r_moon = hypot(x - (1 - mu), y);
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + y*p_x - x*p_y - (1 - mu)/r_earth - mu/r_moon;
    monitor jacobi = -2*H
}

hamiltonian! {
    /// The same in the time s: t becomes a coordinate, and with its momentum on the shell everything
    /// moves as it did.
    pub struct SlowNearBodies { mu = 0.012277471 }
    let r_earth = hypot(x + mu, y);
    let r_moon = hypot(x - (1 - mu), y);
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + y*p_x - x*p_y - (1 - mu)/r_earth - mu/r_moon;
    dt = (r_earth*r_moon)^(3/2)*ds
}

const PERIOD: f64 = 17.065216560157964;

/// One period with steps of `ds`: their number, and how far (x, y, p_x, p_y) is off.
fn slowed(ds: f64, x: f64, p_y: f64) -> Result<(u64, f64), Error> {
    let system = SlowNearBodies::default();
    // (x, y, t; p_x, p_y, p_t)
    let mut start = system.on_shell(&State::new([x, 0.0, 0.0], [0.0, p_y, 0.0]));
    let mut run = Integrator::new(&system, RungeKutta4, start.clone(), ds)?;
    while run.state().q[2] < PERIOD {
        run.advance(1)?;
    }
    // Back to the very end of the period: by Newton's iteration, as dt/ds = ∂H/∂p_t.
    let mut end = run.state().clone();
    for _ in 0..8 {
        let left = (PERIOD - end.q[2]) / system.gradient(&end).p[2];
        if left == 0.0 {
            break;
        }
        end = Integrator::new(&system, RungeKutta4, end, left)?
            .advance(1)?
            .clone();
    }
    start.q[2] = PERIOD;
    let off = (end.q - start.q).norm().max((end.p - start.p).norm());
    Ok((run.steps(), off))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let system = ThreeBody::default();
    // p = (ẋ − y, ẏ + x): at rest in the turning frame is not at rest.
    let (x, v) = (0.994, -2.0015851063790824);
    let start = State::new([x, 0.0], [0.0, v + x]);
    print_pieces(&system);

    // One orbit is short and needs small errors, so the order counts.
    let mut checks = Checks::default();
    println!(
        "{:>10} {:>22} {:>14}",
        "steps", "off after one period", "max |ΔH/H₀|"
    );
    let mut off = f64::NAN;
    for steps in [5_000_u64, 10_000, 20_000, 40_000] {
        let step = PERIOD / steps as f64;
        let mut run = Integrator::new(&system, KahanLi8, start.clone(), step)?
            .observe(every(10, EnergyDrift::new()));
        let end = run.advance(steps)?;
        off = (end.q - start.q).norm().max((end.p - start.p).norm());
        let drift = run.observer().inner().max_relative();
        println!("{steps:>10} {off:>22.1e} {drift:>14.1e}");
    }
    checks.compare("off after one period, 40 000 steps", off, 0.0, 5e-7);
    // What remains is rounding: Gauss's method carries low words.
    let mut run = Integrator::new(&system, Gauss::<8>::default(), start.clone(), PERIOD / 1e4)?;
    let end = run.advance(10_000)?;
    let off = (end.q - start.q).norm().max((end.p - start.p).norm());
    println!("{:>10} {off:>22.1e}  with Gauss, 8 stages", 10_000);
    checks.compare("the same with Gauss, 10 000 steps", off, 0.0, 1e-8);
    println!("in the time s:");
    let mut off = f64::NAN;
    for ds in [0.01, 0.005, 0.0025, 0.00125] {
        let steps;
        (steps, off) = slowed(ds, x, v + x)?;
        println!("{steps:>10} {off:>22.1e}");
    }
    checks.compare("the same in the time s, shortest step", off, 0.0, 1e-6);

    let mut run = Integrator::new(&system, KahanLi8, start.clone(), 1e-3)?;
    let at_5 = run.advance_to(5.0)?;
    let known = [
        0.0226887836479771,
        0.866540140171247,
        -0.984276618812112,
        -0.399097020514901,
    ];
    for (name, (found, known)) in ["x", "y", "p_x", "p_y"]
        .iter()
        .zip(at_5.q.iter().chain(&at_5.p).zip(known))
    {
        checks.compare(format!("{name} at t = 5"), *found, known, 1e-8);
    }

    let mut run = Integrator::new(&system, KahanLi8, start, PERIOD / 20_000.0)?;
    let orbit: Result<Vec<_>, Error> = run
        .states(4)
        .take(5000)
        .map(|state| state.map(|state| (state.q[0], state.q[1])))
        .collect();
    // At rest in the rotating frame, near the point that forms an equilateral triangle with Earth and Moon.
    let (x, y) = (0.5 - system.mu + 0.01, 0.75_f64.sqrt());
    let mut contest = Contest::new(&system, State::new([x, y], [-y, x]), 0.05, 1e4);
    contest.enter_others()?;
    contest.enter("exact flows, Strang", Strang)?;
    let fourth = contest.enter("exact flows, Blanes–Moan 4", BlanesMoan4)?;
    contest.draw(
        "About the point L₄, steps of 0.05",
        "target/three_body/energy.svg",
    )?;
    checks.compare("about L₄, Blanes–Moan 4: max |H − H(0)|", fourth, 0.0, 1e-9);

    let circle = |x: f64, radius: f64| {
        (0..=60)
            .map(|k| (f64::from(k) * std::f64::consts::TAU / 60.0).sin_cos())
            .map(|(sin, cos)| (x + radius * cos, radius * sin))
            .collect()
    };
    Figure {
        title: "Arenstorf's orbit, in the frame turning with Earth and Moon".into(),
        x: "x".into(),
        y: "y".into(),
        equal: true,
        curves: vec![
            Curve {
                name: "spacecraft".into(),
                points: orbit?,
            },
            Curve {
                name: "Moon (to scale)".into(),
                points: circle(1.0 - system.mu, 1737.0 / 384_400.0),
            },
            Curve {
                name: "Earth (to scale)".into(),
                points: circle(-system.mu, 6371.0 / 384_400.0),
            },
        ],
        ..Default::default()
    }
    .write(Path::new("target/three_body/orbit.svg"))?;
    println!("Written to target/three_body/orbit.svg");
    checks.finish()
}
