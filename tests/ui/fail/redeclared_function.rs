use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { let sin = q; H = p^2/2 + sin };
}
