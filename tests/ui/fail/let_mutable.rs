use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { let mut V = q^2/2; H = p^2/2 + V };
}
