use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Coupled<const N: usize> {
        M: [N][N],
        v: [3],
    }
    H(q[N]; p[N]) = dot(p, M*p)/2 + norm(M*v)
}

fn main() {}
