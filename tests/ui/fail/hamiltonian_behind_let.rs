use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { let H = p^2/2 };
}
