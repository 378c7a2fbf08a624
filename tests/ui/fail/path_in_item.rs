use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Pendulum {}
    H = p^2/2 + std::f64::consts::E*q^2/2
}

fn main() {}
