//! Without `std`.
#![no_std]
#![deny(warnings, missing_docs)]
#![forbid(unsafe_code)]

use mechanics::prelude::*;

hamiltonian! {
    /// A lattice of particles.
    pub struct Toda<const N: usize> { c = 0.5 }
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 + c*exp(q[i] - q[(i + 1) % N]) }
}

/// A definition that is a value, run.
///
/// # Errors
/// If the run does.
pub fn run(k: f64) -> Result<f64, Error> {
    let spring = hamiltonian! { H = p^2/2 + k*q^2/2 };
    let mut run = Integrator::new(
        &spring,
        StormerVerlet::default(),
        State::new([1.0], [0.0]),
        1e-3,
    )?;
    run.advance(10)?;
    Ok(run.state().q[0])
}
