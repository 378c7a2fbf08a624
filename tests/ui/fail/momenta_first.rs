use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(p; q) = p^2/2 + q^2/2 };
}
