use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = q^2/2 };
}
