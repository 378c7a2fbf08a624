//! Pieces whose sums are taken apart in another way than those of H.

use hamiltonian::prelude::*;

hamiltonian! {
    /// A ring whose last bond stands by itself in the pieces.
    pub struct Ring<const N: usize> {}
    H(q[N]; p[N]) = norm_squared(p)/2 + sum(i in 0..N) { q[i]*q[(i + 1) % N] };
    split {
        Kinetic = norm_squared(p)/2;
        Chain = sum(i in 0..N - 1) { q[i]*q[i + 1] } + q[N - 1]*q[0];
    }
}

hamiltonian! {
    /// The author's word for it.
    pub struct Assumed<const N: usize> {}
    H(q[N]; p[N]) = norm_squared(p)/2 + sum(i in 0..N) { q[i]*q[(i + 1) % N] };
    #[assume]
    split {
        Kinetic = norm_squared(p)/2;
        Chain = sum(i in 0..N - 1) { q[i]*q[i + 1] } + q[N - 1]*q[0];
    }
}

hamiltonian! {
    /// Not for what is false.
    pub struct Wrong<const N: usize> {}
    H(q[N]; p[N]) = norm_squared(p)/2 + sum(i in 0..N) { q[i]*q[(i + 1) % N] };
    #[assume]
    split {
        Kinetic = norm_squared(p)/2;
        Chain = sum(i in 0..N - 1) { q[i]*q[i + 1] };
    }
}

fn main() {}
