use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(q[3], r[2]; p[3], s[2]) = norm_squared(q - r)/2 + norm_squared(p) };
}
