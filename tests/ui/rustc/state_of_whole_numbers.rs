use hamiltonian::prelude::*;

fn main() {
    let _ = State::new([1], [0]);
}
