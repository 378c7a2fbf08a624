use hamiltonian::hamiltonian;

hamiltonian! {
    #[max_ops = few]
    pub struct Oscillator {}
    H = p^2/2 + q^2/2
}

fn main() {}
