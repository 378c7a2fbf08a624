use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Oscillator {
        m = 1/2,
    }
    H = p^2/(2*m) + q^2/2
}

fn main() {}
