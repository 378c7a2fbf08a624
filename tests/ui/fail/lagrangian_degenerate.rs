use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Degenerate {}
    L(a, b; va, vb) = (va + vb)^2/2 - a^2 - b^2
}

fn main() {}
