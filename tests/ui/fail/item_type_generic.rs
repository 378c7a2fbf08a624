use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Oscillator<T> {}
    H = p^2/2 + q^2/2
}

fn main() {}
