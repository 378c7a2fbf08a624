use hamiltonian::hamiltonian;

fn main() {
    let _ = hamiltonian! { L(x, vx; y, vy) = (vx^2 + vy^2)/2 - x^2 - y^2 };
}
