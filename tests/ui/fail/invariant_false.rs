use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct HenonHeiles {}
    H(x, y; p_x, p_y) = (p_x^2 + p_y^2)/2 + (x^2 + y^2)/2 + x^2*y - y^3/3;
    invariant angular_momentum = x*p_y - y*p_x
}

fn main() {}
