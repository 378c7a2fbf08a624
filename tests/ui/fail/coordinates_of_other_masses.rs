use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Bodies<const N: usize> {
        m = 1.0,
    }
    H(q[N][3]; p[N][3]) = sum(i in 0..N) { norm_squared(p[i])/(2*m) };
    coordinates jacobi(q, m)
}

fn main() {}
