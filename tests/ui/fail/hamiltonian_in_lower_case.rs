use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { h = p^2/2 };
}
