use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Oscillator {
        m: [3, 3],
    }
    H(q[3]; p[3]) = norm_squared(p)/2
}

fn main() {}
