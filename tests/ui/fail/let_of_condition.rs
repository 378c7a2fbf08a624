use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { let inside = q > 0; H = p^2/2 + inside };
}
