use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(q[N]; p[N]) = norm_squared(p)/2 };
}
