use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(x, y; p_x) = p_x^2/2 };
}
