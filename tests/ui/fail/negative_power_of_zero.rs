use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { let zero = 0.1 + 0.2 - 0.3; H = p^2/2 + zero^-2*q };
}
