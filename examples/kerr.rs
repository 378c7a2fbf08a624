//! A geodesic round a rotating black hole, and its fourth constant.
//!
//! Boyer–Lindquist coordinates, units with G = c = M = 1, proper time (divided by the mass of the particle).
//! Besides the energy E, the angular momentum L and the mass, B. Carter (Physical Review 174, 1559, 1968) found a
//! fourth constant, which follows from no symmetry of the coordinates. The macro proves it, with the mass written
//! as μ² = −2H.
//!
//! In proper time τ no piece of H has a flow in closed form. In a time λ with dτ = Σ dλ (Y. Mino, Physical Review D
//! 67, 084027, 2003) H splits into two pieces that have one, and schemes of every order are explicit.
//!
//! The program prints, for an orbit near a circular one in the equatorial plane, the numbers of vertical and radial
//! oscillations per revolution. Newtonian gravity gives 1 and 1; general relativity has a closed form (A. Okazaki,
//! S. Kato, J. Fukue, PASJ 39, 457, 1987). For a generic orbit it prints the drift of the constants. Pictures:
//! `target/kerr/torus.svg` has that orbit in the plane (r sin θ, r cos θ) with the horizon,
//! `target/kerr/energy.svg` the drift of H in the time λ.

use checks::Checks;
use energy::{Contest, print_pieces};
use hamiltonian::analysis::{Branch, momentum_from_energy};
use hamiltonian::plot::{Curve, Figure};
use hamiltonian::prelude::*;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::path::Path;

#[path = "support/checks.rs"]
mod checks;
#[path = "support/energy.rs"]
mod energy;

hamiltonian! {
    /// Geodesics of the Kerr metric.
    pub struct Kerr {
        /// The spin of the hole, 0 to 1.
        a = 0.9,
        /// The energy of the particle, −p_t.
        E,
    }
    let Delta = r^2 - 2*r + a^2;
    let Sigma = r^2 + a^2*cos(theta)^2;
    H(r, theta, phi; p_r, p_theta, L) = (Delta*p_r^2 + p_theta^2
        - ((r^2 + a^2)*E - a*L)^2/Delta + (L - a*E*sin(theta)^2)^2/sin(theta)^2)/(2*Sigma);
    invariant carter = p_theta^2 + cos(theta)^2*(a^2*(-2*H - E^2) + L^2/sin(theta)^2)
}

hamiltonian! {
    /// The same in Mino's time: τ becomes the last coordinate.
    pub struct InMinosTime {
        /// The spin of the hole, 0 to 1.
        a = 0.9,
        /// The energy of the particle, −p_t.
        E,
    }
    let Delta = r^2 - 2*r + a^2;
    let Sigma = r^2 + a^2*cos(theta)^2;
    H(r, theta, phi; p_r, p_theta, L) = (Delta*p_r^2 + p_theta^2
        - ((r^2 + a^2)*E - a*L)^2/Delta + (L - a*E*sin(theta)^2)^2/sin(theta)^2)/(2*Sigma);
    invariant carter = p_theta^2 + cos(theta)^2*(a^2*(-2*H - E^2) + L^2/sin(theta)^2);
    dt = Sigma*ds
}

/// A particle of mass 1 has H = −1/2: `p_theta` is found such that it is.
const SHELL: f64 = -0.5;
const P_THETA: usize = 1;

/// Revolutions in φ per vertical and per radial oscillation, near the circular orbit at `r`.
fn turns(a: f64, r: f64) -> Result<(f64, f64), Error> {
    let root = (1.0 - 3.0 / r + 2.0 * a / r.powf(1.5)).sqrt();
    let energy = (1.0 - 2.0 / r + a / r.powf(1.5)) / root;
    let momentum = r.sqrt() * (1.0 - 2.0 * a / r.powf(1.5) + (a / r).powi(2)) / root;
    // A little more energy than that of the circular orbit excites both oscillations.
    let kerr = Kerr {
        a,
        E: energy + 1e-6,
    };
    let guess = State::new([r, FRAC_PI_2, 0.0], [0.0, 0.0, momentum]);
    let start = momentum_from_energy(&kerr, &guess, P_THETA, SHELL, Branch::Forward)?;

    let system = InMinosTime { a, E: kerr.E };
    let start = system.from_declared(&start);
    let mut run = Integrator::new(&system, BlanesMoan6, start, 0.002)?;
    let (mut up, mut out) = (Turns::default(), Turns::default());
    for state in run.states(1).take(70_000) {
        let State { q, p, .. } = state?;
        up.note(q[1] - FRAC_PI_2, q[2]);
        out.note(p[0], q[2]);
    }
    Ok((up.mean(), out.mean()))
}

/// The φ of the first and of the last crossing of 0 upwards, and the number of crossings.
#[derive(Default)]
struct Turns {
    before: Option<(f64, f64)>,
    first: Option<f64>,
    last: f64,
    count: f64,
}

impl Turns {
    fn note(&mut self, value: f64, phi: f64) {
        if let Some((old, old_phi)) = self.before
            && old < 0.0
            && value >= 0.0
        {
            let at = old_phi - old * (phi - old_phi) / (value - old);
            match self.first {
                None => self.first = Some(at),
                Some(_) => (self.last, self.count) = (at, self.count + 1.0),
            }
        }
        self.before = Some((value, phi));
    }
    fn mean(&self) -> f64 {
        (self.last - self.first.unwrap_or(f64::NAN)) / self.count / TAU
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut checks = Checks::default();
    let (a, r) = (0.9_f64, 6.0_f64);
    let (up, out) = turns(a, r)?;
    let up_known = 1.0 - 4.0 * a / r.powf(1.5) + 3.0 * (a / r).powi(2);
    let out_known = 1.0 - 6.0 / r + 8.0 * a / r.powf(1.5) - 3.0 * (a / r).powi(2);
    checks.compare(
        "r = 6: ups and downs a turn",
        1.0 / up,
        up_known.sqrt(),
        1e-4,
    );
    checks.compare(
        "r = 6: ins and outs a turn",
        1.0 / out,
        out_known.sqrt(),
        1e-4,
    );

    // A generic orbit and a long run: a symplectic scheme. The implicit midpoint rule is one for every H.
    let kerr = Kerr::new(0.95);
    let guess = State::new([8.0, FRAC_PI_2, 0.0], [0.0, 0.0, 2.0]);
    let start = momentum_from_energy(&kerr, &guess, P_THETA, SHELL, Branch::Forward)?;
    println!("{kerr}\n");
    println!(
        "starts at r = 8 with p_theta = {}, Carter's constant {}",
        start.p[P_THETA],
        kerr.carter(&start)
    );
    let first = start.clone();
    let mut run = Integrator::new(&kerr, ImplicitMidpoint::default(), start, 0.1)?
        .observe((EnergyDrift::new(), Monitors::new()));
    let mut torus = Vec::new();
    for state in run.states(5).take(40_000) {
        let state = state?;
        if torus.len() < 3000 {
            let (sin, cos) = state.q[1].sin_cos();
            torus.push((state.q[0] * sin, state.q[0] * cos));
        }
    }
    let (drift, monitors) = run.observer();
    let carter = monitors
        .get("carter")
        .map_or(f64::NAN, |m| m.max_relative());
    checks.compare(
        "μ² to proper time 20 000: max relative change",
        drift.max_relative(),
        0.0,
        1e-4,
    );
    checks.compare("Carter's constant: the same", carter, 0.0, 1e-3);

    let system = InMinosTime { a, E: kerr.E };
    let start = system.from_declared(&first);
    print_pieces(&system);
    let mut run = Integrator::new(&system, KahanLi8, start.clone(), 0.01)?.observe(Monitors::new());
    run.advance_to(100.0)?;
    println!("in Mino's time to 100, which is τ = {}", run.state().q[3]);
    let carter = (run.observer().get("carter")).map_or(f64::NAN, |m| m.max_relative());
    checks.compare("Carter's constant in Mino's time", carter, 0.0, 1e-10);
    let mut contest = Contest::new(&system, start, 0.005, 500.0);
    contest.enter_others()?;
    contest.enter("exact flows, Strang", Strang)?;
    let fourth = contest.enter("exact flows, Blanes–Moan 4", BlanesMoan4)?;
    contest.draw(
        "A geodesic of Kerr in Mino’s time, steps of 0.005; (29) lies under Strang",
        "target/kerr/energy.svg",
    )?;
    checks.compare("Blanes–Moan 4: max |H − H(0)|", fourth, 0.0, 1e-6);

    let horizon = 1.0 + (1.0 - a * a).sqrt();
    let half = (0..=60).map(|k| (f64::from(k) * TAU / 120.0).sin_cos());
    Figure {
        title: "A geodesic round a black hole of spin 0.9, in the plane that turns with it".into(),
        x: "r sin θ".into(),
        y: "r cos θ".into(),
        equal: true,
        curves: vec![
            Curve {
                name: "particle".into(),
                points: torus,
            },
            Curve {
                name: "horizon".into(),
                points: half
                    .map(|(sin, cos)| (horizon * sin, horizon * cos))
                    .collect(),
            },
        ],
        ..Default::default()
    }
    .write(Path::new("target/kerr/torus.svg"))?;
    println!("Written to target/kerr/torus.svg");
    checks.finish()
}
