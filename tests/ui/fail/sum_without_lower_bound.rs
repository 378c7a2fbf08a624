use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(q[3]; p[3]) = sum(i in ..3) { p[i]^2/2 } };
}
