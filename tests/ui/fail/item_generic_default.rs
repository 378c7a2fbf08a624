use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Chain<const N: usize = 3> {}
    H(q[N]; p[N]) = norm_squared(p)/2
}

fn main() {}
