use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Chain<const N: usize> {}
    H(q[N]; p[N]) = norm_squared(p)/2;
    monitor momenta = p
}

fn main() {}
