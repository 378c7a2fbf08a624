use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = 1e400*p^2 + q^2/2 };
}
