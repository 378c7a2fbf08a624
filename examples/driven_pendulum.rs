//! A pendulum that stands upright because its pivot oscillates (P. L. Kapitza, 1951).
//!
//! H depends on time. With the pivot at a·cos(ωt), the upright position is stable if (aω)² > 2gl; the pendulum then
//! swings slowly about it. The section takes one point per period of the drive, at the same phase. Regular orbits
//! are curves in the section, chaotic orbits are clouds.
//!
//! The program prints the stability on both sides of the limit, and the slow frequency beside the theory of fast
//! driving. Picture: `target/driven_pendulum/section.svg`; 0 is hanging, ±π is upright.

use checks::Checks;
use hamiltonian::plot::{Curve, Figure};
use hamiltonian::prelude::*;
use std::f64::consts::{PI, TAU};
use std::path::Path;

#[path = "support/checks.rs"]
mod checks;

hamiltonian! {
    /// A pendulum of mass 1 in the frame of its pivot, which is at height a·cos(ω t).
    pub struct DrivenPendulum {
        /// Length of the rod.
        l = 1.0,
        /// Acceleration of gravity.
        g = 1.0,
        /// The amplitude of the pivot, up and down.
        a,
        /// Its angular frequency.
        omega,
    }
    // The frame's acceleration is added to gravity.
    let weight = g - a*omega^2*cos(omega*t);
    H(theta; p; t) = p^2/(2*l^2) - weight*l*cos(theta);
    monitor height = -l*cos(theta)
}

/// Steps to a period of the drive, so that the section needs no interpolation.
const STEPS: u64 = 200;

/// The lowest height reached from near the highest point, and the mean period of the swing about it.
fn upside_down(pendulum: &DrivenPendulum) -> Result<(f64, f64), Error> {
    let step = TAU / pendulum.omega / STEPS as f64;
    // With the fast oscillation that accompanies a displacement of 0.02.
    let start = State::new([PI - 0.02 * (1.0 - pendulum.a)], [0.0]);
    let mut lowest = f64::INFINITY;
    let mut crossings = Vec::new();
    let mut before = 0.0;
    // H = T(p) + V(θ, t) is separable at every time: explicit and symplectic.
    let mut run = Integrator::new(pendulum, StormerVerlet::default(), start, step)?;
    // At one phase of the drive, the fast oscillation is not seen.
    for state in run.states(STEPS).take(1000) {
        let state = state?;
        lowest = pendulum.height(&state).min(lowest);
        let lean = state.q[0] - PI;
        if before < 0.0 && lean >= 0.0 {
            crossings.push(state.t - lean / (lean - before) * TAU / pendulum.omega);
        }
        before = lean;
    }
    let swing = match (crossings.first(), crossings.last()) {
        (Some(first), Some(last)) => (last - first) / (crossings.len() as f64 - 1.0),
        _ => f64::NAN,
    };
    Ok((lowest, swing))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut checks = Checks::default();
    let omega = 50.0;
    let shaken = |a_omega: f64| DrivenPendulum::new(a_omega / omega, omega);
    println!("{}", shaken(2.0));
    let limit = 2.0_f64.sqrt();

    let (lowest, _) = upside_down(&shaken(0.95 * limit))?;
    checks.compare(
        "5 % below the limit: falls to the height",
        lowest,
        -1.0,
        0.1,
    );
    let (lowest, _) = upside_down(&shaken(1.05 * limit))?;
    checks.compare(
        "5 % above the limit: stays at the height",
        lowest,
        1.0,
        0.01,
    );
    let (_, swing) = upside_down(&shaken(2.0))?;
    // The mean force of fast shaking: frequency² = (aω)²/2l² − g/l.
    checks.compare(
        "aω = 2: period of the swing about the top",
        swing,
        TAU,
        0.02,
    );

    // A slower drive: islands about both equilibria in a chaotic sea.
    let pendulum = DrivenPendulum::new(0.3, 6.0);
    let step = TAU / pendulum.omega / STEPS as f64;
    let mut curves = Vec::new();
    // Starts (θ, p).
    let chaotic: &[(f64, f64)] = &[(1.8, 0.0), (1.0, 1.0), (1.2, 3.0), (-1.2, -3.0)];
    let hanging = &[
        (0.07, 0.0),
        (0.15, 0.0),
        (0.2, 0.0),
        (0.62, 0.0),
        (0.7, 0.0),
    ];
    let upright = &[
        (PI - 0.1, 0.0),
        (PI - 0.2, 0.0),
        (PI - 0.3, 0.0),
        (PI - 0.4, 0.0),
    ];
    let carried = &[
        (PI, 6.5),
        (PI, 7.5),
        (PI, 8.5),
        (PI, -6.5),
        (PI, -7.5),
        (PI, -8.5),
    ];
    let free = &[
        (0.0, 6.5),
        (0.0, 7.5),
        (0.0, 8.5),
        (0.0, -6.5),
        (0.0, -7.5),
        (0.0, -8.5),
    ];
    for (name, starts) in [
        ("chaotic", chaotic),
        ("about the lowest point", hanging),
        ("about the highest point", upright),
        ("carried round, a turn a period", carried),
        ("rotating", free),
    ] {
        let mut points = Vec::new();
        for &(theta, p) in starts {
            let start = State::new([theta], [p]);
            let mut run = Integrator::new(&pendulum, StormerVerlet::default(), start, step)?;
            for state in run.states(STEPS).take(1500) {
                let state = state?;
                points.push((state.q[0] - TAU * (state.q[0] / TAU).round(), state.p[0]));
            }
        }
        curves.push(Curve {
            name: name.into(),
            points,
        });
    }
    Figure {
        title: "A pendulum with a shaken pivot, seen once a period: l = g = 1, a = 0.3, ω = 6"
            .into(),
        x: "θ".into(),
        y: "p".into(),
        dots: true,
        range: Some(-14.0..18.0),
        curves,
        ..Default::default()
    }
    .write(Path::new("target/driven_pendulum/section.svg"))?;
    println!("Written to target/driven_pendulum/section.svg");
    checks.finish()
}
