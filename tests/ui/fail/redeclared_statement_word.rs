use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { let force = q; H = p^2/2 + force };
}
