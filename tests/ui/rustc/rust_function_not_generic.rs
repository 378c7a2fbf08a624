use hamiltonian::prelude::*;

fn well(x: f64) -> f64 {
    x * x
}

fn slope(x: f64) -> f64 {
    2.0 * x
}

hamiltonian! {
    /// A function that works with one scalar only.
    pub struct Well {}
    fn f(x) = well, (slope);
    H = p^2/2 + f(q)
}

fn main() {
    let _ = Well::default().energy(&State::new([1.0], [0.0]));
}
