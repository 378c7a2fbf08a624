use hamiltonian::{prelude::*, schemes::Pihajoki};

hamiltonian! {
    /// A pendulum in air.
    pub struct Air { c = 0.4 }
    H = p^2/2 - cos(q);
    force(q; p) = -c*abs(p)*p
}

fn main() -> Result<(), Error> {
    let start = State::new([0.5], [0.0]);
    Integrator::new(&Air::default(), Pihajoki::default(), start, 1e-3)?;
    Ok(())
}
