use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Oscillator {
        m = 1.0,
        m = 2.0,
    }
    H = p^2/(2*m) + q^2/2
}

fn main() {}
