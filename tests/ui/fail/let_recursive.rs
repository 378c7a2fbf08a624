use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { let V = V + q^2; H = p^2/2 + V };
}
