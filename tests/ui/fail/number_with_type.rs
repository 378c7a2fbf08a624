use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = 0.5f64*p^2 + q^2/2 };
}
