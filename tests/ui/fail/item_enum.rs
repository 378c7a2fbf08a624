use hamiltonian::hamiltonian;

hamiltonian! {
    pub enum Oscillator {}
    H = p^2/2 + q^2/2
}

fn main() {}
