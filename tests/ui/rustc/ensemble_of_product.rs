//! An ensemble is refused with the message of a run.

use hamiltonian::prelude::*;

hamiltonian! {
    /// Not separable.
    pub struct Coupled {}
    H(q; p) = (q^2 + 1)*(p^2 + 1)/2
}

fn main() {
    let start = |_| (Coupled {}, State::new([1.0], [0.0]));
    let _ = Ensemble::new(10, start, StormerVerlet::default(), 0.1);
}
