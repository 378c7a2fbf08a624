use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Oscillator {
        m =
    }
    H = p^2/(2*m) + q^2/2
}

fn main() {}
