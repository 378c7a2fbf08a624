use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = p^2/2 + sum(k in -2..3) { k*q^2 } };
}
