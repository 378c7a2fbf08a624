use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = .5*p^2 + q^2/2 };
}
