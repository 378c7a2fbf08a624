use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(x, p_x; y, p_y) = (p_x^2 + p_y^2)/2 + x^2 + y^2 };
}
