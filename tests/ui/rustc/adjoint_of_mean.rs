use hamiltonian::{prelude::*, schemes::CheapProcessed4};
use hamiltonian::schemes::Adjoint;

hamiltonian! {
    /// A pendulum.
    pub struct Pendulum {}
    H(theta; p) = p^2/2 - cos(theta)
}

fn main() -> Result<(), Error> {
    let start = State::new([0.5], [0.0]);
    let scheme = Adjoint(CheapProcessed4::default());
    let mut run = Integrator::new(&Pendulum {}, scheme, start, 0.1)?;
    run.advance(10)?;
    Ok(())
}
