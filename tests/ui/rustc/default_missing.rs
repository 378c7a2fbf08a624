use hamiltonian::prelude::*;

hamiltonian! {
    /// An oscillator whose mass must be given.
    pub struct Oscillator { m, k = 1.0 }
    H = p^2/(2*m) + k*q^2/2
}

fn main() {
    let _ = Oscillator::default();
    let _ = Oscillator { k: 2.0, ..Default::default() };
}
