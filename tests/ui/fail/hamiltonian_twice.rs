use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = p^2/2; H = p^2/2 + q^2/2 };
}
