use hamiltonian::prelude::*;

hamiltonian! {
    /// An oscillator.
    pub struct Oscillator { m = 1.0, k = 1.0 }
    H = p^2/(2*m) + k*q^2/2
}

fn main() {
    let oscillator = Oscillator { mass: 2.0, ..Default::default() };
    let _ = oscillator.energy(&State::new([1.0], [0.0]));
}
