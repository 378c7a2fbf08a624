use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(q[2, 3]; p[2, 3]) = 1 };
}
