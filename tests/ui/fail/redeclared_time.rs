use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { let t = q; H(q; p; t) = p^2/2 + t };
}
