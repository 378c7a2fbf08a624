use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Pendulum {}
    H = p^2/2 - cos(PI*q)
}

fn main() {}
