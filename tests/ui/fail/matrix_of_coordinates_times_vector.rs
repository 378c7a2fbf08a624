use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Coupled {}
    H(q[3][3]; p[3][3]) = norm_squared(q*p[0])/2
}

fn main() {}
