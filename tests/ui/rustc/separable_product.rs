use hamiltonian::prelude::*;

hamiltonian! {
    /// Equation (34).
    pub struct Coupled {}
    H = 0.5*(q^2 + 1)*(p^2 + 1)
}

fn main() -> Result<(), Error> {
    let start = State::new([1.0], [0.0]);
    Integrator::new(&Coupled::default(), StormerVerlet::default(), start, 1e-3)?;
    Ok(())
}
