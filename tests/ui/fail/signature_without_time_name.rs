use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(q; p;) = p^2/2 };
}
