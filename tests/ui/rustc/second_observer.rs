use hamiltonian::prelude::*;

hamiltonian! {
    /// A stone.
    pub struct Falling { g = 9.81 }
    H(x; p) = p^2/2 + g*x
}

fn main() -> Result<(), Error> {
    let start = State::new([5.0], [0.0]);
    let run = Integrator::new(&Falling::default(), StormerVerlet::default(), start, 1e-3)?
        .observe(EnergyDrift::new())
        .observe(Recorder::new());
    drop(run);
    Ok(())
}
