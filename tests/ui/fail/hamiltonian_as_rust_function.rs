use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { fn H(q, p) { p^2/2 } };
}
