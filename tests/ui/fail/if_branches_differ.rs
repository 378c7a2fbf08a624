use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = p^2/2 + norm(if q > 0 { [q, q] } else { q }) };
}
