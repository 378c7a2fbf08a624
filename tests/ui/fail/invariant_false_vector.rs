use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Kepler {}
    H(q[3]; p[3]) = norm_squared(p)/2 - 1/norm(q);
    invariant runge_lenz = cross(p, cross(q, p)) + q/norm(q)
}

fn main() {}
