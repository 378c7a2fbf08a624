use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Oscillator {
        q = 1.0,
    }
    H = p^2/2 + q^2/2
}

fn main() {}
