use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(q; p, t) = p^2/2 + q*cos(t) };
}
