//! Orbits round a black hole, without and with a magnetic field.
//!
//! Schwarzschild coordinates, units with G = c = M = 1, proper time (divided by the mass of the particle), so that
//! H = −½ on every orbit. H is not separable: p_r² has a factor that depends on r. But every term of H has a flow
//! in closed form, so the composition of these flows is explicit and symplectic (four of them by hand: Y. Wang, W.
//! Sun, F. Liu, X. Wu, Astrophysical Journal 907, 66, 2021). A uniform field β along the axis changes the potential
//! alone, and the orbit of a charge becomes chaotic.
//!
//! The program prints the radial period and the angle of the periapsis's advance, both known as integrals; an orbit
//! beside a solution in quadruple precision; and the drift of H over a million steps. Pictures:
//! `target/schwarzschild/energy.svg` and `field.svg` have the drift of H, `orbits.svg` the orbits.

use checks::Checks;
use energy::{Contest, print_pieces};
use hamiltonian::View;
use hamiltonian::analysis::{Branch, momentum_from_energy};
use hamiltonian::plot::{Curve, Figure};
use hamiltonian::prelude::*;
use std::f64::consts::FRAC_PI_2;
use std::path::Path;

#[path = "support/checks.rs"]
mod checks;
#[path = "support/energy.rs"]
mod energy;

hamiltonian! {
    /// Orbits round a black hole, in the pieces that the macro finds.
    pub struct Schwarzschild {
        /// The energy of the particle, −p_t.
        E,
    }
    H(r, theta, phi; p_r, p_theta, L) = (1 - 2/r)*p_r^2/2 + p_theta^2/(2*r^2)
        - E^2/(2*(1 - 2/r)) + L^2/(2*r^2*sin(theta)^2);
}

hamiltonian! {
    /// The orbits of a charge in a field along the axis, in four pieces by hand.
    pub struct InField {
        /// The energy of the particle, −p_t.
        E,
        /// The field, times the charge.
        beta = 0.0,
    }
    let potential = -E^2/(2*(1 - 2/r)) + (L - beta*r^2*sin(theta)^2/2)^2/(2*r^2*sin(theta)^2);
    H(r, theta, phi; p_r, p_theta, L) = (1 - 2/r)*p_r^2/2 + p_theta^2/(2*r^2) + potential;
    split {
        Potential = potential;
        Turning = p_theta^2/(2*r^2);
        Radial = p_r^2/2;
        Falling = -p_r^2/r;
    }
}

/// A particle of mass 1 has H = −1/2: `p_theta` is found such that it is.
const SHELL: f64 = -0.5;
const P_THETA: usize = 1;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut checks = Checks::default();

    // In the equatorial plane, from r = 12/1.3 to 12/0.7 and back: semilatus rectum 12, eccentricity 0.3.
    let bound = Schwarzschild {
        E: 0.965_355_742_557_886,
    };
    let start = State::new(
        [12.0 / 1.3, FRAC_PI_2, 0.0],
        [0.0, 0.0, 4.020_151_261_036_848],
    );
    let period = 361.863_612_556_420_13;
    let mut run = Integrator::new(&bound, KahanLi8, start, period / 1000.0)?;
    let end = run.advance(1000)?;
    print_pieces(&bound);
    checks.compare("r after a radial period", end.q[0], 12.0 / 1.3, 1e-9);
    checks.compare("p_r after it", end.p[0], 0.0, 1e-9);
    checks.compare("φ turned by in it", end.q[2], 8.902_518_432_362_845, 1e-9);

    let mut orbits = Vec::new();
    for (beta, p_theta, known, figure) in [
        (0.0, 2.062_449_325_976_816, 7.29e-6, "energy"),
        (8.9e-4, 2.178_571_077_150_622, 4.08e-6, "field"),
    ] {
        let by_hand = InField { E: 0.995, beta };
        let guess = State::new([11.0, FRAC_PI_2, 0.0], [0.0, 0.0, 4.6]);
        let start = momentum_from_energy(&by_hand, &guess, P_THETA, SHELL, Branch::Forward)?;
        let found = start.p[P_THETA];
        checks.compare(
            format!("β = {beta}: p_θ where H = −½"),
            found,
            p_theta,
            1e-13,
        );

        println!("\nβ = {beta}, steps of 1:");
        let mut contest = Contest::new(&by_hand, start.clone(), 1.0, 1e5);
        contest.enter_others()?;
        let moved = contest.enter("four by hand, Strang", Strang)?;
        contest.enter("four by hand, Blanes–Moan 4", BlanesMoan4)?;
        contest.enter("four by hand, Kahan–Li 8", KahanLi8)?;
        contest.draw(
            &format!("Schwarzschild, β = {beta}: how far H moves, steps of 1"),
            &format!("target/schwarzschild/{figure}.svg"),
        )?;
        checks.compare(format!("β = {beta}: max |H + ½|"), moved, known, 2e-8);

        let mut points = Vec::new();
        let watcher = watch(|view: &View<'_, f64, InField>| {
            let q = &view.state.q;
            points.push((
                q[0] * q[1].sin() * q[2].cos(),
                q[0] * q[1].sin() * q[2].sin(),
            ));
        });
        let mut run =
            Integrator::new(&by_hand, Strang, start.clone(), 1.0)?.observe(every(4, watcher));
        run.advance(20_000)?;
        drop(run);
        orbits.push(Curve {
            name: format!("β = {beta}"),
            points,
        });
        if beta == 0.0 {
            let system = Schwarzschild { E: 0.995 };
            let mut run = Integrator::new(&system, KahanLi8, start, 0.5)?;
            let end = run.advance_to(1000.0)?;
            let known = [
                ("r", end.q[0], 122.486_719_036_045),
                ("θ", end.q[1], 1.495_696_594_046_55),
                ("φ", end.q[2], 3.310_205_354_485_87),
                ("p_r", end.p[0], 0.069_598_468_153_017_1),
                ("p_θ", end.p[1], -2.033_200_752_273_33),
            ];
            for (name, found, known) in known {
                checks.compare(format!("{name} at τ = 1000"), found, known, 1e-10);
            }
        }
    }
    Figure {
        title: "Orbits from one place, from above: without and with a field".into(),
        x: "x".into(),
        y: "y".into(),
        equal: true,
        curves: orbits,
        ..Default::default()
    }
    .write(Path::new("target/schwarzschild/orbits.svg"))?;
    println!("Written to target/schwarzschild/orbits.svg");
    checks.finish()
}
