//! Code that is generic over the scalar of the parameters, without its bound.

use hamiltonian::prelude::*;

hamiltonian! {
    /// A pendulum.
    pub struct Pendulum { l = 1.0 }
    H(theta; p) = p^2/(2*l^2) - l*cos(theta)
}

fn energy<P>(pendulum: &Pendulum<P>) -> f64 {
    System::energy(pendulum, &State::new([0.5], [0.0]))
}

fn main() {
    let _ = energy(&Pendulum::default());
}
