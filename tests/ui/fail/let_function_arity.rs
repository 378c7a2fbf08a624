use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { let V(r) = r^2/2; H = p^2/2 + V(q, 2) };
}
