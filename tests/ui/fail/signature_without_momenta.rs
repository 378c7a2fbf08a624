use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(x, y, p_x, p_y) = (p_x^2 + p_y^2)/2 };
}
