use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(q; p; t; s) = p^2/2 };
}
