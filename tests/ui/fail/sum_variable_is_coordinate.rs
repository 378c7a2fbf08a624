use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(q[3]; p[3]) = sum(q in 0..3) { p[q]^2/2 } };
}
