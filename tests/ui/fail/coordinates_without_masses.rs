use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Bodies<const N: usize> {
        m: [N],
    }
    H(q[N][3]; p[N][3]) = sum(i in 0..N) { norm_squared(p[i])/(2*m[i]) };
    coordinates jacobi(q)
}

fn main() {}
