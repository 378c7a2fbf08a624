use hamiltonian::prelude::*;

/// The name of the type of a piece.
pub struct DampedKinetic;

hamiltonian! {
    /// A piece `Kinetic` is a type `DampedKinetic`.
    pub struct Damped {}
    H(q; p) = p^2/2 - cos(q);
    split { Kinetic = p^2/2; Potential = -cos(q) }
}

fn main() {}
