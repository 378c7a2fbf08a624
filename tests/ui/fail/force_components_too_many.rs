use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { H(x, y; u, v) = (u^2 + v^2)/2; force(x, y; u, v) = [-u, -v, 0] };
}
