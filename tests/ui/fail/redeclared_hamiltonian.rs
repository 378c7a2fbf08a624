use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { let H = q^2; H = p^2/2 };
}
