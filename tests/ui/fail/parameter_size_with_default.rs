use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Chain {
        n: usize = 3,
    }
    H(q[n]; p[n]) = norm_squared(p)/2
}

fn main() {}
