use hamiltonian::prelude::*;

hamiltonian! {
    /// Oscillators; `k` has a default and is no argument of `new`.
    pub struct Oscillators { m: [n], k = 1.0, n: usize }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/(2*m[i]) + k*q[i]^2/2 }
}

fn main() {
    let _ = Oscillators::new(2, 1.0, vec![1.0; 2]);
}
