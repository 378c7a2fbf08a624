use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Oscillator {}
    H = p^2/2 + q^2/2;
    #[assume] invariant momentum = p
}

fn main() {}
