use hamiltonian::prelude::*;

hamiltonian! {
    /// An oscillator in the plane.
    pub struct Oscillator { k = 1.0 }
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + k*(x^2 + y^2)/2
}

fn main() {
    let _ = Oscillator::default().energy(&State::new([1.0], [0.0]));
}
