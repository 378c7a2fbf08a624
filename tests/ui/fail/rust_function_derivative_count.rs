use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { fn f(x, y) = well, (well_x); H = p^2/2 + f(q, 1) };
}
