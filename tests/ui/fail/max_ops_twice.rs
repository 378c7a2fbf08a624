use hamiltonian::hamiltonian;

hamiltonian! {
    #[max_ops = 4]
    #[max_ops = 5]
    pub struct Oscillator {}
    H = p^2/2 + q^2/2
}

fn main() {}
