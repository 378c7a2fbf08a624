use hamiltonian::prelude::*;

hamiltonian! {
    /// A relativistic particle in a magnetic field.
    pub struct Relativistic { B = 1.0 }
    let A = [0, B*q[0], 0];
    H(q[3]; p[3]) = sqrt(1 + norm_squared(p - A)) + q[2]
}

fn main() -> Result<(), Error> {
    let start = State::new([0.0; 3], [1.0; 3]);
    Integrator::new(&Relativistic::default(), StormerVerlet::default(), start, 1e-3)?;
    Ok(())
}
