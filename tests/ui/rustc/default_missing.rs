use hamiltonian::prelude::*;

hamiltonian! {
    /// An oscillator whose mass must be given.
    pub struct Oscillator { m, k = 1.0 }
    H = p^2/(2*m) + k*q^2/2
}

hamiltonian! {
    /// A chain whose size is set at run time.
    pub struct Chain { n: usize, m: [n], k = 1.0 }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/(2*m[i]) + k*q[i]^2/2 }
}

hamiltonian! {
    /// A well of any form.
    pub struct Well { V: fn(x), k = 1.0 }
    H(x; p) = p^2/2 + k*V(x)
}

fn main() {
    let _ = Oscillator::default();
    let _ = Oscillator { k: 2.0, ..Default::default() };
    let _ = Chain::default();
    let _: Chain = Default::default();
    let _: Well<Spline> = Default::default();
}
