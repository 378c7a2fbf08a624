use hamiltonian::prelude::*;

hamiltonian! {
    /// A weight on a bent wire.
    pub struct Wire {}
    H(q; p) = p^2/(2*(1 + q^2)) + q^2/2
}

fn main() -> Result<(), Error> {
    let start = State::new([1.0], [0.0]);
    Integrator::new(&Wire::default(), Strang, start, 1e-3)?;
    Ok(())
}
