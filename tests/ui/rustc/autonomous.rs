use hamiltonian::{Autonomous, hamiltonian};

hamiltonian! {
    /// A driven oscillator.
    pub struct Driven { a = 0.1 }
    H(q; p; t) = p^2/2 + q^2/2 - a*q*cos(t)
}

fn conserves_energy<S: Autonomous>(_: &S) {}

fn main() {
    conserves_energy(&Driven::default());
}
