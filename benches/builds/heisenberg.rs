//! Heisenberg's chain of a hundred spins, one run by `Gauss<2>`; z is the momentum of the angle.

use hamiltonian::prelude::*;

hamiltonian! {
    pub struct Spins { n: usize }
    H(phi[n]; z[n]) = -sum(i in 0..n - 1) {
        z[i]*z[i + 1] + sqrt((1 - z[i]^2)*(1 - z[i + 1]^2))*cos(phi[i] - phi[i + 1])
    };
    invariant magnetisation = sum(i in 0..n) { z[i] }
}

fn main() -> Result<(), Error> {
    let n = 100;
    let phi = (0..n).map(|i| 0.1 * (i as f64).sin()).collect::<Vec<_>>();
    let z = (0..n)
        .map(|i| 0.2 * (0.3 * i as f64).cos())
        .collect::<Vec<_>>();
    let system = Spins::new(n)?;
    let mut run = Integrator::new(&system, Gauss::<2>::default(), State::new(phi, z), 0.05)?
        .observe(EnergyDrift::new());
    run.advance(1_000)?;
    println!("max |ΔH/H₀| = {:.1e}", run.observer().max_relative());
    Ok(())
}
