use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { fn f(x, y) = g, (gx, gy), (gxx, gyy); H = p^2/2 + f(q, 1) };
}
