use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(q[0]; p[0]) = 1 };
}
