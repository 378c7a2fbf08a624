use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Quartic {}
    L(q; v) = v^4/4 - q^2/2
}

fn main() {}
