//! Particles in a harmonic well with a thermostat: Störmer–Verlet, and between its steps the exact Ornstein–Uhlenbeck
//! process of the momenta, p ← e^(−γτ)·p + √(T(1 − e^(−2γτ)))·ξ with normal ξ (G. E. Uhlenbeck, L. S. Ornstein, 1930,
//! doi:10.1103/PhysRev.36.823).
//!
//! The process keeps a normal distribution of p with the variance T. A step of kick–drift–kick conserves
//! p²/2 + k(1 − kh²/4)·q²/2. Both therefore keep a distribution that is known without an error of the step: p² has the mean
//! T, q² the mean T/(k(1 − kh²/4)), and q⁴ three times the square of that. The program compares 10⁴ particles with it.

use checks::Checks;
use hamiltonian::prelude::*;
use std::f64::consts::TAU;

#[path = "support/checks.rs"]
mod checks;

hamiltonian! {
    /// A particle of mass 1 in a harmonic well.
    pub struct Well {
        /// The force at distance 1.
        k = 1.0,
    }
    H(q; p) = p^2/2 + k*q^2/2
}

/// Normal numbers: SplitMix64, then the transform of Box and Muller (1958, doi:10.1214/aoms/1177706645).
struct Normal(u64);

impl Normal {
    /// A number between 0 and 1, never 0.
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ (x >> 31)) >> 11) as f64 / (1_u64 << 53) as f64 + 0.5 / (1_u64 << 53) as f64
    }
    fn next(&mut self) -> f64 {
        let radius = (-2.0 * self.uniform().ln()).sqrt();
        radius * (TAU * self.uniform()).cos()
    }
}

const PARTICLES: usize = 10_000;
const TEMPERATURE: f64 = 0.7;
const FRICTION: f64 = 0.5;
/// A long step, so that its effect on q² is seen.
const STEP: f64 = 0.5;
/// The steps between two kicks of the thermostat.
const STEPS: u64 = 2;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let well = Well::default();
    let start = |_| (well.clone(), State::new([1.0], [0.0]));
    let mut gas = Ensemble::new(PARTICLES, start, StormerVerlet::default(), STEP)?;
    let mut normal = Normal(2026);
    let keeps = (-FRICTION * STEP * STEPS as f64).exp();
    let adds = (TEMPERATURE * (1.0 - keeps * keeps)).sqrt();
    let mut moments = [0.0; 3];
    let mut count = 0.0;
    for round in 0..220 {
        gas.advance(STEPS);
        gas.update(|_, state| state.p[0] = keeps * state.p[0] + adds * normal.next());
        // After 20 rounds the start is forgotten; rounds ten apart are nearly independent.
        if round >= 20 && round % 10 == 0 {
            for state in gas.states() {
                let state = state?;
                let (q, p) = (state.q[0], state.p[0]);
                for (moment, value) in moments.iter_mut().zip([p * p, q * q, q.powi(4)]) {
                    *moment += value;
                }
                count += 1.0;
            }
        }
    }
    let [p2, q2, q4] = moments.map(|moment| moment / count);
    let width = TEMPERATURE / (well.k * (1.0 - well.k * STEP * STEP / 4.0));
    // Four standard errors of the mean of squares, whose variance is 2, and of fourth powers, 96, of their squared means.
    let error = |variance: f64| 4.0 * (variance / count).sqrt();
    let mut checks = Checks::default();
    checks.compare("mean of p^2 / T", p2 / TEMPERATURE, 1.0, error(2.0));
    checks.compare(
        "mean of q^2 / (T/(k(1 - kh^2/4)))",
        q2 / width,
        1.0,
        error(2.0),
    );
    checks.compare(
        "mean of q^4 / 3 of its square",
        q4 / (3.0 * width * width),
        1.0,
        error(96.0 / 9.0),
    );
    let plain = q2 / (TEMPERATURE / well.k);
    checks.compare(
        "the same without the step's effect",
        plain,
        1.0 / (1.0 - 0.25 * STEP * STEP),
        error(2.0) * 1.1,
    );
    checks.finish()
}
