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

hamiltonian! {
    /// A size of run time, vectors, an observable.
    pub struct Bodies { n: usize, m: [n] }
    H(q[n][3]; p[n][3]) = sum(i in 0..n) { norm_squared(p[i])/(2*m[i]) + norm(q[i]) };
    monitor momentum = sum(i in 0..n) { p[i] }
}

hamiltonian! {
    /// Mixed shapes and time.
    pub struct Mixed { w: [3][3] }
    H(x, q[3]; y, p[3]; t) = x^2 + y^2*cos(t) + dot(q, w*p)
}

hamiltonian! {
    /// Pieces of its own, in other coordinates.
    pub struct Planar { k = 1.0 }
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - k/hypot(x, y);
    coordinates polar(x, y);
    split { Kinetic = (p_x^2 + p_y^2)/2; Potential = -k/hypot(x, y) }
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
