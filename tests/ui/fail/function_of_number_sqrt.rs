use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { let i = sqrt(-1); H = p^2/2 + i*q };
}
