use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(x; p_x, p_y) = p_x^2/2 };
}
