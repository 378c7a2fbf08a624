use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Damped { n: usize, g = 0.1 }
    H(q[n]; p[n]) = norm_squared(p)/2 + norm_squared(q)/2;
    dt = (1 + norm_squared(q))*ds;
    force(q; p) = -g*p
}

fn main() {}
