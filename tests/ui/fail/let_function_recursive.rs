use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { let f(x) = x*f(x - 1); H = p^2/2 + f(q) };
}
