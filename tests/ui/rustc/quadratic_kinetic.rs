use hamiltonian::{QuadraticKinetic, hamiltonian};

hamiltonian! {
    /// A relativistic oscillator.
    pub struct Relativistic { c = 1.0 }
    H = c*sqrt(c^2 + p^2) + q^2/2
}

hamiltonian! {
    /// A mass that depends on the coordinate.
    pub struct Bead {}
    H = p^2/(2*(1 + q^2)) + q^2/2
}

fn second_order<S: QuadraticKinetic>(_: &S) {}

fn main() {
    second_order(&Relativistic::default());
    second_order(&Bead::default());
}
