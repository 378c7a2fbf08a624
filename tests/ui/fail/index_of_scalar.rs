use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = p[0]^2/2 };
}
