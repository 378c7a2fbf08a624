use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { let type = q; H = p^2/2 + q };
}
