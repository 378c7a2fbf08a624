use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(q[2]; p[2]) = norm(cross(q, p)) };
}
