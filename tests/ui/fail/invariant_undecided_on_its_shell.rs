use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Oscillator {}
    H = p^2/2 + q^2/2;
    invariant momentum = p on H = -1
}

fn main() {}
