use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Pendulum {
        m = 1.0,
    }
    let T = p^2/(2*mm);
    H = T + V;
    monitor e = T - U
}

fn main() {}
