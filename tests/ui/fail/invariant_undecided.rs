use hamiltonian::{Real, hamiltonian};

fn well<T: Real>(q: T) -> T {
    q * q * q * q
}

fn slope<T: Real>(q: T) -> T {
    T::constant(4.0, 0.0) * q * q * q
}

hamiltonian! {
    pub struct Well {}
    fn f(x) = well, (slope);
    H = p^2/2 + f(q);
    invariant energy_as_written = p^2/2 + q^4
}

fn main() {}
