use hamiltonian::hamiltonian;

hamiltonian! {
    //! An oscillator.
    pub struct Oscillator {}
    H = p^2/2 + q^2/2
}

fn main() {}
