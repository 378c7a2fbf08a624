use hamiltonian::hamiltonian;

fn well(q: f64) -> f64 {
    q.powi(4) - q * q
}

fn slope(q: f64) -> f64 {
    4.0 * q.powi(3) - 2.0 * q
}

hamiltonian! {
    pub struct Well {}
    fn f(x) = well, (slope);
    H = p^2/2 + f(q);
    invariant energy_as_written = p^2/2 + q^4 - q^2
}

fn main() {}
