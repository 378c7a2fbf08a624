use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Coupled<const N: usize> {
        M: [N][N],
    }
    H(q[N]; p[N]) = dot(p*M, p)/2
}

fn main() {}
