use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Coupled { n: usize }
    L(q[n]; v[n]) = sum(i in 0..n) { v[i]^2/2 } + sum(i in 1..n) { v[i]*v[i - 1]/4 } - norm_squared(q)
}

fn main() {}
