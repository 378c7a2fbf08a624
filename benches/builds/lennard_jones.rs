//! Atoms in a periodic box, one run with observers: the nearest image of a distance by the sine of its phase.

use hamiltonian::prelude::*;
use std::f64::consts::PI;

hamiltonian! {
    pub struct Atoms { n: usize, box_length = 8.0 }
    let image(d) = box_length/pi*asin(sin(pi*d/box_length));
    let pair(r2) = 4*(1/r2^6 - 1/r2^3);
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i]) }/2
        + sum(i in 0..n, j in 0..i) {
            pair(image(q[i][0] - q[j][0])^2 + image(q[i][1] - q[j][1])^2 + image(q[i][2] - q[j][2])^2)
        };
    monitor kinetic = sum(i in 0..n) { norm_squared(p[i]) }/2
}

fn main() -> Result<(), Error> {
    let n = 256;
    let system = Atoms {
        box_length: 8.0,
        ..Atoms::new(n)?
    };
    let q: Vec<[f64; 3]> = (0..n)
        .map(|i| [i % 7, i / 7 % 7, i / 49].map(|k| 8.0 / 7.0 * k as f64))
        .collect();
    let p = (0..n)
        .map(|i| [0.1 * (PI * i as f64).sin(), 0.1 * (i as f64).cos(), 0.0])
        .collect();
    let mut run = Integrator::new(&system, StormerVerlet::default(), State::new(q, p), 1e-3)?
        .observe((EnergyDrift::new(), every(10, Monitors::new())));
    run.advance(1_000)?;
    println!("max |ΔH/H₀| = {:.1e}", run.observer().0.max_relative());
    Ok(())
}
