//! A ring of waveguides: the discrete nonlinear Schrödinger equation, and the break-up of a wave.
//!
//! i dψₙ/dt = g|ψₙ|²ψₙ − ψₙ₊₁ − ψₙ₋₁ with ψ = q + ip. H is of degree four and not separable. The terms of one site
//! rotate ψ there by a constant angle; the term of two neighbours rotates the two values of ψ. The composition of
//! these rotations is explicit and symplectic, and keeps the number of particles Σ|ψ|², as each rotation does.
//!
//! A wave whose sites alternate in sign, A(−1)ⁿ exp(−iωt), is a solution. For g > 0 it is unstable: ripples of wave
//! number Q grow with the rate √(ε(2gA² − ε)), where ε = 4 sin²(Q/2) (Y. S. Kivshar and M. Peyrard, Physical Review
//! A 46, 3198, 1992), until the wave is a row of peaks.
//!
//! The program prints this rate of growth and the drift of the constants. Pictures: `target/nls/energy.svg` has the
//! drift of H, `peaks.svg` the wave as it breaks up.

use checks::Checks;
use energy::{Contest, print_pieces};
use hamiltonian::plot::{Curve, Figure};
use hamiltonian::prelude::*;
use std::f64::consts::TAU;
use std::path::Path;

#[path = "support/checks.rs"]
mod checks;
#[path = "support/energy.rs"]
mod energy;

hamiltonian! {
    /// A ring of N sites.
    pub struct Ring<const N: usize> {
        /// The strength of the interaction at a site.
        g = 1.0,
    }
    H(q[N]; p[N]) = sum(i in 0..N) { g*(q[i]^2 + p[i]^2)^2/4 }
        - sum(i in 0..N) { q[i]*q[(i + 1) % N] + p[i]*p[(i + 1) % N] };
    invariant particles = sum(i in 0..N) { q[i]^2 + p[i]^2 }
}

const SITES: usize = 32;
/// The number of ripples on the ring.
const RIPPLES: f64 = 4.0;
type Wave = StateOf<Ring<SITES>>;

/// −1 at every other site, and the ripple there.
fn at(site: usize) -> (f64, f64) {
    let sign = if site.is_multiple_of(2) { 1.0 } else { -1.0 };
    (sign, (TAU * RIPPLES * site as f64 / SITES as f64).cos())
}

/// The height of the ripple in the amplitude of a wave at any phase.
fn ripple(wave: &Wave, angle: f64) -> f64 {
    let (sin, cos) = angle.sin_cos();
    let of_site = |site: usize| {
        let (sign, form) = at(site);
        sign * form * (wave.q[site] * cos - wave.p[site] * sin)
    };
    (0..SITES).map(of_site).sum::<f64>() * 2.0 / SITES as f64
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut checks = Checks::default();
    let ring = Ring::<SITES>::default();
    print_pieces(&ring);

    let amplitude = 0.8_f64;
    let square = ring.g * amplitude * amplitude;
    let omega = square + 2.0;
    let epsilon = 4.0 * (0.5 * TAU * RIPPLES / SITES as f64).sin().powi(2);
    let rate = (epsilon * (2.0 * square - epsilon)).sqrt();
    // The wave with the ripple that grows and has no decaying part.
    let wave = |height: f64| {
        let (mut q, mut p) = ([0.0; SITES], [0.0; SITES]);
        for site in 0..SITES {
            let (sign, form) = at(site);
            q[site] = sign * (amplitude + height * form);
            p[site] = -sign * height * form * rate / epsilon;
        }
        State::new(q, p)
    };
    let start = wave(1e-7);
    let before = ripple(&start, 0.0);
    let t = 8.0;
    let mut run = Integrator::new(&ring, BlanesMoan6, start, 0.02)?;
    let after = ripple(run.advance_to(t)?, omega * t);
    checks.compare("rate of growth", (after / before).ln() / t, rate, 1e-6);

    println!("The wave as it breaks:");
    let start = wave(1e-3);
    let mut contest = Contest::new(&ring, start.clone(), 0.02, 500.0);
    contest.enter_others()?;
    let second = contest.enter("exact flows, Strang", Strang)?;
    contest.enter("exact flows, Blanes–Moan 4", BlanesMoan4)?;
    contest.draw(
        "A ring of 32 sites: how far H moves, steps of 0.02",
        "target/nls/energy.svg",
    )?;
    checks.compare("Strang to t = 500: max |H − H(0)|", second, 0.0, 1e-2);

    let mut run = Integrator::new(&ring, BlanesMoan4, start, 0.02)?.observe(Monitors::new());
    let mut curves = Vec::new();
    for t in [0.0, 6.0, 10.0, 500.0] {
        let wave = run.advance_to(t)?.clone();
        let of_site = |i: usize| (i as f64, wave.q[i].powi(2) + wave.p[i].powi(2));
        curves.push(Curve {
            name: format!("t = {t}"),
            points: (0..SITES).map(of_site).collect(),
        });
        let particles = run.observer().get("particles");
        let moved = particles.map_or(f64::NAN, |m| m.max_relative());
        checks.compare(format!("particles to t = {t}: change"), moved, 0.0, 1e-12);
    }
    Figure {
        title: "A wave breaks up on a ring of 32 sites".into(),
        x: "site n".into(),
        y: "|ψ|²".into(),
        curves,
        ..Default::default()
    }
    .write(Path::new("target/nls/peaks.svg"))?;
    println!("Written to target/nls/peaks.svg");
    checks.finish()
}
