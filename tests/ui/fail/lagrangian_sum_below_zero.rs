use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Below { n: usize }
    L(q[n]; v[n]) = sum(i in 0..n) { v[i]^2/2 } + sum(i in 0..n - 1, j in i..n) { v[i + 1]*q[j] }
}

fn main() {}
