use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = p^2/0x2 + q^2/2 };
}
