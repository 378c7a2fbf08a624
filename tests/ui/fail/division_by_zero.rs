use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = p^2/2 + q/(1/2 + 1/2 - 1) };
}
