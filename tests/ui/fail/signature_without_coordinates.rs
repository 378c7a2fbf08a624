use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(; p) = p^2/2 };
}
