use hamiltonian::hamiltonian;

fn well(q: f64) -> f64 {
    q.powi(4)
}

fn slope(q: f64) -> f64 {
    4.0 * q.powi(3)
}

hamiltonian! {
    pub struct Well {}
    fn f(x) = well, (slope);
    H(q; p) = p^2/2 + bracket(p, f(q))^2;
    monitor plain = f(q)
}

fn main() {}
