use hamiltonian::hamiltonian;

hamiltonian! {
    pub struct Damped { n: usize, g = 0.1 }
    H(q[n]; p[n]) = sum(i in 0..n) { (p[i] + p[(2*i) % n])^2 + q[i]^2 };
    dt = (1 + norm_squared(q))*ds;
    force(q; p) = -g*p
}

fn main() {}
