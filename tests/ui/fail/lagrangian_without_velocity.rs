use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { L(q; v) = -q^2/2 };
}
