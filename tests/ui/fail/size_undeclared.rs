use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Chain {}
    H(q[n]; p[n]) = norm_squared(p)/2
}

fn main() {}
