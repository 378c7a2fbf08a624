use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H() = 1 };
}
