use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Nothing {}
    H = p^2/2 - p^2/2 + q^2
}

fn main() {}
