use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { let V = q^2/2, H = p^2/2 + V };
}
