use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Ring<const N: usize> {}
    L(q[N]; v[N]) = sum(i in 0..N) { (i + 1)*v[i]^2/2 - (q[(i + 1) % N] - q[i])^2/2 };
    monitor stretching = sum(i in 0..N) { (v[(i + 1) % N] - v[i])^2 }
}

fn main() {}
