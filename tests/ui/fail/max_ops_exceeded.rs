use hamiltonian::hamiltonian;

hamiltonian! {
    #[max_ops = 5]
    pub struct Pendulum { m = 1.0, l = 1.0, g = 9.81 }
    H(theta; p) = p^2/(2*m*l^2) - m*g*l*cos(theta)
}

fn main() {}
