use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { fn f(x) = well; H = p^2/2 + f(q) };
}
