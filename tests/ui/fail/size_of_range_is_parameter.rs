use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Chain {
        k = 3,
    }
    H(q[3]; p[3]) = sum(i in 0..k) { p[i]^2/2 }
}

fn main() {}
