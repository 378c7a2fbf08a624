use hamiltonian::prelude::*;

fn main() -> Result<(), Error> {
    let c = 0.5;
    let coupled = hamiltonian! { H = p^2/2 + q^2/2 + c*q*p };
    let start = State::new([1.0], [0.0]);
    Integrator::new(&coupled, StormerVerlet::default(), start, 1e-3)?;
    Ok(())
}
