use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { L(q; v) = v^2/2 + H };
}
