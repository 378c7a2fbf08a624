use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = p^2/2 + if q > 0 { let a = q; a } else { 0 } };
}
