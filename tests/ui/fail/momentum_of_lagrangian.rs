//! A Lagrangian's momentum under another name.

use hamiltonian::prelude::*;

hamiltonian! {
    /// A pendulum.
    pub struct Pendulum {}
    L(theta; omega) = omega^2/2 + cos(theta);
    monitor swing = p*theta
}

fn main() {}
