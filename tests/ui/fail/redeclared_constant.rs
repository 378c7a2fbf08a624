use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { let pi = 3; H = p^2/2 + pi*q };
}
