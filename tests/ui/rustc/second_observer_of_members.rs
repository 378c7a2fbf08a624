use hamiltonian::prelude::*;

hamiltonian! {
    /// A stone.
    pub struct Falling { g = 9.81 }
    H(x; p) = p^2/2 + g*x
}

fn start(_: Member) -> (Falling, StateOf<Falling>) {
    (Falling::default(), State::new([5.0], [0.0]))
}

fn main() -> Result<(), Error> {
    let _ = Ensemble::new(10, start, StormerVerlet::default(), 1e-3)?
        .observe(|_| EnergyDrift::new())
        .observe(|_| Recorder::new());
    let _ = Sweep::new(10, start, StormerVerlet::default(), 1e-3)
        .observe(|_| EnergyDrift::new())
        .observe(|_| Recorder::new());
    Ok(())
}
