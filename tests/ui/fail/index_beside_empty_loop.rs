use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Chain<const N: usize> {}
    H(q[N]; p[N]) = norm_squared(p)/2 + sum(i in 0..N, j in i + 1..N) { q[i + 1]*q[j] }
}

fn main() {}
