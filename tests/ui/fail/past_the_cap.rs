//! More operations than a definition may have, by a sum that cannot stay a loop.

use hamiltonian::prelude::*;

hamiltonian! {
    /// Waves in two directions by turns.
    pub struct Waves {}
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + sum(i in 0..20000) { sin(i*[x, y][i % 2]) }
}

fn main() {}
