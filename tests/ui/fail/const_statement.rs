use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { const k = 1; H = p^2/2 + k*q^2/2 };
}
