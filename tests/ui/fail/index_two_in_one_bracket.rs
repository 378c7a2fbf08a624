use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(q[3][3]; p[3][3]) = p[0, 1]^2/2 };
}
