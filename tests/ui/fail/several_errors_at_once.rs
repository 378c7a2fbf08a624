use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { let V = 2q^2; let T = p**2/2; H = T + V + .5 };
}
