use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { let f(x) = g(x) + 1; let g(x) = f(x) + 1; H = p^2/2 + f(q) };
}
