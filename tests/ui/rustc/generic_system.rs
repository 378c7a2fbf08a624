//! Code that is generic over the system, without its bound.

use hamiltonian::prelude::*;

fn drift<S>(system: &S, start: State<hamiltonian::nalgebra::SVector<f64, 1>>) -> f64 {
    system.energy(&start)
}

fn steps<S: System>(system: &S, start: StateOf<S>) -> Result<StateOf<S>, Error> {
    let mut run = Integrator::new(system, StormerVerlet::default(), start, 1e-2)?;
    Ok(run.advance(10)?.clone())
}

fn energy<S>(system: &S, start: StateOf<S>) -> f64 {
    System::energy(system, &start)
}

fn main() {}
