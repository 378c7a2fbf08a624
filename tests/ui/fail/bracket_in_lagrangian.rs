use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Spring {}
    let b = bracket(x, v);
    L(x; v) = v^2/2 - b*x^2/2
}

fn main() {}
