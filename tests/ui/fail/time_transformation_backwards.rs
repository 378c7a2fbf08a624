use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Backwards {}
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 - 1/hypot(x, y);
    dt = -hypot(x, y)*ds
}

fn main() {}
