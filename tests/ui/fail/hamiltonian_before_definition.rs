use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { let e = H; H = p^2/2 + e };
}
