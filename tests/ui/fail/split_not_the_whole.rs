use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Pendulum { m = 1.0 }
    H = p^2/(2*m) - cos(q);
    split { T = p^2/2; V = -cos(q) }
}

fn main() {}
