use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { fn f(x) = 2*x, (2); H = p^2/2 + f(q) };
}
