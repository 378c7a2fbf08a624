use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Toda<const N: usize> {}
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/2 + exp(q[i] - q[(i + 1) % N]) };
    invariant centre = sum(i in 0..N) { q[i] }
}

fn main() {}
