use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = p^2/2 + q^2/2; split { T = p^2/2; V = q^2/2 } };
}
