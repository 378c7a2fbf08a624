//! A system whose parameters all have defaults has no `new`; a type may have one of its own, or from a
//! trait.

use hamiltonian::prelude::*;

hamiltonian! {
    /// A pendulum.
    pub struct Pendulum { m = 1.0, l = 1.0 }
    H(theta; p) = p^2/(2*m*l^2) - m*l*cos(theta)
}

hamiltonian! {
    /// A system without parameters.
    pub struct Plain {}
    H = p^2/2 - cos(q)
}

hamiltonian! {
    /// A spring that is made of its frequency.
    pub struct Spring { k = 1.0 }
    H(x; p) = p^2/2 + k*x^2/2
}

impl Spring {
    fn new(omega: f64) -> Self {
        Spring { k: omega * omega }
    }
}

hamiltonian! {
    /// A rotor, which a trait makes.
    pub struct Rotor { i = 1.0 }
    H(phi; l) = l^2/(2*i)
}

trait Make {
    fn new() -> Self;
}

impl Make for Rotor {
    fn new() -> Self {
        Rotor::default()
    }
}

fn main() {
    let _: Rotor = Rotor::new();
    let _ = Pendulum::<f64>::new(1.0, 2.0);
    let _ = Pendulum::new(1.0, 2.0);
    let _ = Plain::new();
    let _ = Spring::new(2.0);
}
