use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(q[2][2][2]; p[2][2][2]) = 1 };
}
