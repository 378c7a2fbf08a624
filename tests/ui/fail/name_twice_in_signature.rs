use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(q; q) = q^2/2 };
}
