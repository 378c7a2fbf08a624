use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Kepler {}
    H = p^2/2 - 1/q;
    dt = 0*ds
}

fn main() {}
