use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Pendulum {
        m = 1.0,
    }
}

fn main() {}
