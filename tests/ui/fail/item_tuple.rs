use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Oscillator(f64);
    H = p^2/2 + q^2/2
}

fn main() {}
