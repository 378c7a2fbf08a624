use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { #[inline] H = p^2/2 };
}
