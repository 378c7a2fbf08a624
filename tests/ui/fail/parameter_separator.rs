use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Oscillator {
        m = 1.0;
        k = 1.0;
    }
    H = p^2/(2*m) + k*q^2/2
}

fn main() {}
