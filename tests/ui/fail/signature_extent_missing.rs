use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(q[]; p[]) = 1 };
}
