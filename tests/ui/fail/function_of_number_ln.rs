use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = p^2/2 + ln(1 - 1)*q };
}
