use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = p.powi(2)/2 + q^2/2 };
}
