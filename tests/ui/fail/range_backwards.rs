use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(q[3]; p[3]) = norm_squared(p)/2 + sum(i in 3..0) { q[i]^2 } };
}
