#![deny(unused_variables)]

use hamiltonian::prelude::*;

/// No name that an unread parameter may not have.
pub const G: f64 = 9.81;

hamiltonian! {
    /// A spring, of whose names `k`, `n`, `G` and `unread` are not read.
    pub struct Spring {
        m = 1.0,
        k = 2.0,
        n: usize,
        G = 3.0,
        _meant = 3.0,
        #[allow(unused_variables)]
        allowed = 1.0,
    }
    let unread = m^2;
    H(x; p) = p^2/(2*m) + x^2
}

hamiltonian! {
    /// Whatever is not read here is meant so.
    #[allow(unused)]
    pub struct Allowed { k = 2.0 }
    H(x; p) = p^2/2 + x^2
}

fn main() {}
