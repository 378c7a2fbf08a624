use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = p^2/2 + q as f64 };
}
