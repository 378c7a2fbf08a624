use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = p^2/2 + if 0 < q < 1 { q } else { 1 } };
}
