use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { let T = p^2/(2*mu); let mu = 2; H = T + q^2/2 };
}
