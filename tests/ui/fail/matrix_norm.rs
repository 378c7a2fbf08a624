use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(q[4][3]; p[4][3]) = norm_squared(p)/2 };
}
