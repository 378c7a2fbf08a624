use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { p^2/2 + q^2/2 };
}
