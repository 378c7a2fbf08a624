use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = p^2/(2*mass) + q^2/2 };
}
