use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { let q = 1; H = p^2/2 + q^2/2 };
}
