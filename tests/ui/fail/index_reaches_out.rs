use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! {
        H(q[3]; p[3]) = norm_squared(p)/2 + sum(i in 0..3) { (q[i + 1] - q[i])^2 }
    };
}
