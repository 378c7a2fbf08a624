//! The conditional of C.

use hamiltonian::prelude::*;

hamiltonian! {
    /// A wall.
    pub struct Wall {}
    H = p^2/2 + (q > 0 ? q : 0)
}

fn main() {}
