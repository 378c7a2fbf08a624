use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Pendulum {}
    H = p^2/(2*body.mass) + q^2/2
}

fn main() {}
