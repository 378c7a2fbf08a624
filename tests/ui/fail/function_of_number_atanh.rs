use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { let bound(x) = atanh(2*x); H = p^2/2 + bound(-0.5)*q };
}
