use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Pendulum {
        m = 1.0,
    }
    H(theta; p) = p^2/(2*m) - gravity*cos(theta)
}

fn main() {}
