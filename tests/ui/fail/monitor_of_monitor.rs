//! A monitor read by another.

use hamiltonian::prelude::*;

hamiltonian! {
    /// An oscillator.
    pub struct Oscillator {}
    H = p^2/2 + q^2/2;
    monitor phase = atan2(p, q);
    monitor turned = phase/pi
}

fn main() {}
