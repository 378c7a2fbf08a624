use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { monitr e = q; H = p^2/2 };
}
