use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Chain<const N: usize> {}
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 + (q[i + 1] - q[i])^2/2 }
}

fn main() {}
