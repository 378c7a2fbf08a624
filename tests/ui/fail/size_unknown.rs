use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Chain<const N: usize> {}
    H(q[M]; p[M]) = norm_squared(p)/2
}

fn main() {}
