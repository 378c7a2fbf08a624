//! An event of parameters alone.

use hamiltonian::prelude::*;

hamiltonian! {
    /// A particle.
    pub struct Particle { height = 1.0 }
    H = p^2/2 + q;
    event ground = height - 1
}

fn main() {}
