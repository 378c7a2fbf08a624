use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Bodies<const N: usize> {
        m: [N],
    }
    H(q[N]; p[N]) = sum(i in 0..N) { p[i]^2/(2*m) }
}

fn main() {}
