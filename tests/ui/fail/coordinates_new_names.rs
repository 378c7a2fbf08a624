use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Timed {}
    H(q[2]; p[2]) = norm_squared(p)/2 - 1/norm(q);
    coordinates polar(q);
    dt = r*ds
}

hamiltonian! {
    pub struct Known {}
    H(x, y, z; p_x, p_y, p_z) = (p_x^2 + p_y^2 + p_z^2)/2 - 1/sqrt(x^2 + y^2 + z^2);
    coordinates spherical(x, y, z);
    invariant l = p_phi;
    event equator = theta - pi/2
}

fn main() {
    let _ = hamiltonian! {
        H(x, y; p_x, p_y) = p_x^2 + p_y^2 - 1/r;
        coordinates polar(x, y)
    };
}
