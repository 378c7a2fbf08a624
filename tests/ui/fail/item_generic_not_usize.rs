use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Chain<const N: i32> {}
    H(q[N]; p[N]) = norm_squared(p)/2
}

fn main() {}
