use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(q[3]; p[3]) = for i in 0..3 { p[i]^2/2 } };
}
