use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Pendulum {
        mass = 1.0,
        g = 9.81,
    }
    H(theta; p) = p^2/(2*mas) - mass*g*cos(thetta)
}

fn main() {}
