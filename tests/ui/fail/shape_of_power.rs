use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(q[3]; p[3]) = p^2/2 };
}
