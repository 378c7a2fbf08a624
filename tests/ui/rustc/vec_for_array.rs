//! Lists of other lengths or shapes where the compiler knows those of the definition.

use hamiltonian::prelude::*;

hamiltonian! {
    /// Two masses.
    pub struct Two { m: [2] }
    H(q[2]; p[2]) = sum(i in 0..2) { p[i]^2/(2*m[i]) }
}

hamiltonian! {
    /// Any number of masses.
    pub struct Any { n: usize, m: [n] }
    H(q[n]; p[n]) = sum(i in 0..n) { p[i]^2/(2*m[i]) }
}

fn main() -> Result<(), Error> {
    let _ = Two::new(vec![1.0, 2.0]);
    let _ = Two::new([1.0, 2.0]).with_m([1.0]);
    let _ = Any::new(2, [[1.0, 2.0]])?;
    let two = Two::new([1.0, 2.0]);
    let any = Any::new(2, [1.0, 2.0])?;
    let start = State::new(vec![[0.0, 1.0]], vec![[0.0, 0.0]]);
    let _ = Integrator::new(&two, StormerVerlet::default(), start, 0.1)?;
    let start = State::new([0.0], [1.0]);
    let _ = Integrator::new(&two, StormerVerlet::default(), start, 0.1)?;
    let _ = two.energy(&State::new(vec![0.0, 1.0], vec![0.0, 0.0]));
    let _ = any.energy(&State::new([0.0, 1.0], [0.0, 0.0]));
    Ok(())
}
