use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Ring<const N: usize> {}
    H(q[N]; p[N]) = norm_squared(p)/2;
    monitor b = bracket(sum(i in 0..N) { i*q[(i + 2) % N] }, sum(i in 0..N, j in 0..i) { q[i]*p[j] })
}

fn main() {}
