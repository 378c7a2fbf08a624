use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Oscillator {
        m = 1.0,
        k = m,
    }
    H = p^2/(2*m) + k*q^2/2
}

fn main() {}
