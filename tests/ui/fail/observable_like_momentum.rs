//! An observable with a momentum's name.

use hamiltonian::prelude::*;

hamiltonian! {
    /// A particle.
    pub struct Particle {}
    H(x; p_x) = p_x^2/2 + x;
    monitor p_x = x*p_x
}

fn main() {}
