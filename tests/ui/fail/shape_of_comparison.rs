use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(q[3]; p[3]) = if q > p { norm(p) } else { 0 } };
}
