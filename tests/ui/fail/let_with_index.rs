//! An index on the left of a `let`.

use hamiltonian::prelude::*;

hamiltonian! {
    /// A chain.
    pub struct Chain<const N: usize> {}
    let d[i] = q[i] - q[i + 1];
    H(q[N]; p[N]) = norm_squared(p)/2 + sum(i in 0..N - 1) { d[i]^2 }
}

fn main() {}
