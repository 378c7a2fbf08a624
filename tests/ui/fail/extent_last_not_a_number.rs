use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Bodies<const N: usize> {}
    H(q[3][N]; p[3][N]) = norm_squared(p[0])/2
}

fn main() {}
