use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = x^2/2 + v^2/2 };
}
