use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Pendulum {}
    H(theta; p_theta) = p^2/2 - cos(theta)
}

fn main() {}
