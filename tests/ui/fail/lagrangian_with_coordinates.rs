use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Kepler {}
    L(x, y; u, v) = (u^2 + v^2)/2 + 1/sqrt(x^2 + y^2);
    coordinates polar(x, y)
}

fn main() {}
