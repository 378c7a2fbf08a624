use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H = p^2/2 + asin(2)*q + acos(-pi/2) };
}
