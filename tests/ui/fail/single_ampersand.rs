use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = p^2/2 + if q > 0 & p > 0 { 1 } else { 0 } };
}
