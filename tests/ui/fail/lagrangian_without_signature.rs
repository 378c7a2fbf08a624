use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { L = v^2/2 - q^2/2 };
}
