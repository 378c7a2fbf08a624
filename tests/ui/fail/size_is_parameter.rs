use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Chain {
        n = 3,
    }
    H(q[n]; p[n]) = norm_squared(p)/2
}

fn main() {}
