use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = p^2/2; L(q; v) = v^2/2 };
}
