use hamiltonian::prelude::*;

fn main() {
    let k = "stiff";
    let spring = hamiltonian! { H = p^2/2 + k*q^2/2 };
    let _ = spring.energy(&State::new([1.0], [0.0]));
}
