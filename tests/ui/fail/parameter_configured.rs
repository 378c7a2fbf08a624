use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Oscillator {
        #[cfg(test)]
        m = 1.0,
    }
    H = p^2/2 + q^2/2
}

fn main() {}
